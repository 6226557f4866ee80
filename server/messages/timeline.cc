#include "server/messages/timeline.h"

#include "server/codec/list_formats.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"
#include "server/messages/job.h"
#include "server/messages/job_request.h"

namespace armloom {

using namespace formats;

namespace {

// A member of the job as GET /jobs/{id} tells it.
template <class M>
auto of_job(M JobView::*member) {
  return [member](const TimelineLanes::Leg& leg) { return leg.job.*member; };
}

double progress_of(const TimelineLanes::Leg& leg) { return leg.job.motion.progress; }

FormatPtr<TimelineLanes::Pause> pause_format() {
  using Pause = TimelineLanes::Pause;
  return named("TimelinePause", "A leg stands, at its start or on its way.",
               object<Pause>({
                   told("from_s", &Pause::from, cell_time()),
                   told("to_s", &Pause::to, nullable(cell_time()),
                        "null: for ever as things are; then it is the last one"),
                   told("at_s", &Pause::at, seconds({0.0}), "Where, in trajectory time"),
                   told("waits_on", &Pause::waits_on, nullable(wait_format()),
                        "For whom; null: for a reason of its arms' own, expected to last for as "
                        "long again"),
               }));
}

FormatPtr<TimelineLanes::Leg> leg_format() {
  using Leg = TimelineLanes::Leg;
  return named(
      "TimelineStep",
      "A motion that is admitted. It follows the one before it on its arms; that wait is no pause.",
      object<Leg>({
          told("id", of_job(&JobView::key), job_id_format()),
          told("name", of_job(&JobView::name), text(), "For people; may be empty"),
          told("arms", of_job(&JobView::arms), list(text()), "That it moves, each in its lane"),
          told("state", of_job(&JobView::state), job_state_format()),
          told("progress", progress_of, number({0.0, 1.0}),
               "Share of the trajectory's time, at now_s"),
          told("starts_s", &Leg::starts, nullable(cell_time()),
               "Leaves its start, or has left it; null: never, as things are"),
          told("ends_s", &Leg::ends, nullable(cell_time()),
               "null: it does not come to its end as things are; its last pause says what holds it,"
               " unless it is given up and brakes"),
          told("pauses", &Leg::pauses, list(pause_format()), "From now on"),
      }));
}

FormatPtr<TimelineLanes::Lane> lane_format() {
  using Lane = TimelineLanes::Lane;
  return named(
      "TimelineArm", "",
      object<Lane>({
          told("name", &Lane::arm, text(), "The arm"),
          told("steps", &Lane::steps, list(leg_format()), "In the order in which they go"),
          told("waiting", &Lane::waiting, count(),
               "Jobs of the arm (of their `arms`) that have not ended and are no leg: not "
               "admitted, behind the horizon or for other reasons. They have no times yet"),
      }));
}

}  // namespace

FormatPtr<TimelineLanes> timeline_format() {
  using View = TimelineLanes;
  static const auto format =
      named("Timeline", "Times are cell time, if not said otherwise.",
            object<View>({
                told("now_s", &View::now, cell_time()),
                told("horizon_steps", &View::horizon_steps, count(),
                     "So many legs of a lane are admitted at most, the one under way included"),
                told("arms", &View::lanes, list(lane_format()), "In the cell's order"),
            }));
  return format;
}

}  // namespace armloom
