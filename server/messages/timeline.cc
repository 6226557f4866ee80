#include "server/messages/timeline.h"

#include "server/codec/list_formats.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/job.h"
#include "server/messages/job_request.h"

namespace armloom {

using namespace formats;

namespace {

template <class M>
auto of_job(M JobView::*member) {
  return [member](const TimelineLanes::Leg& leg) { return leg.job.*member; };
}

double progress_of(const TimelineLanes::Leg& leg) { return leg.job.motion.progress; }

FormatPtr<TimelineLanes::Pause> pause_format() {
  using Pause = TimelineLanes::Pause;
  return named(
      "TimelinePause", "A pause of a motion, at its start or on its path.",
      object<Pause>({
          output_only("from_s", &Pause::from, cell_time()),
          output_only("to_s", &Pause::to, nullable(cell_time()),
                      "End of the pause; null if no end is predicted (only for the last pause)"),
          output_only("at_s", &Pause::at, seconds({0.0}),
                      "Position of the pause in trajectory time"),
          output_only("waits_on", &Pause::waits_on, nullable(wait_format()),
                      "What the motion waits for; null if its own arms cause the pause. Such a "
                      "pause is predicted to last as long again as it has lasted so far"),
      }));
}

FormatPtr<TimelineLanes::Leg> leg_format() {
  using Leg = TimelineLanes::Leg;
  return named(
      "TimelineStep",
      "An admitted motion. It begins after the previous motion of its arms; the time until then is "
      "not listed as a pause.",
      object<Leg>({
          output_only("id", of_job(&JobView::key), job_id_format()),
          output_only("name", of_job(&JobView::name), text(), "Display name; may be empty"),
          output_only("arms", of_job(&JobView::arms), list(text()),
                      "Arms that the job moves; the motion is listed under each of them"),
          output_only("state", of_job(&JobView::state), job_state_format()),
          output_only("progress", progress_of, number({0.0, 1.0}),
                      "Share of the trajectory's time at `now_s`"),
          output_only("starts_s", &Leg::starts, nullable(cell_time()),
                      "Time at which the motion leaves its start, past or predicted; null if not "
                      "predicted"),
          output_only("ends_s", &Leg::ends, nullable(cell_time()),
                      "Predicted end; null if no end is predicted. The last pause then gives the "
                      "reason, unless the job is canceled and its arm brakes"),
          output_only("pauses", &Leg::pauses, list(pause_format()), "Pauses from now on"),
      }));
}

FormatPtr<TimelineLanes::Lane> lane_format() {
  using Lane = TimelineLanes::Lane;
  return named(
      "TimelineArm", "",
      object<Lane>({
          output_only("name", &Lane::arm, text(), "Name of the arm"),
          output_only("steps", &Lane::steps, list(leg_format()), "Admitted motions in order"),
          output_only("waiting", &Lane::waiting, count(),
                      "Number of jobs of the arm that have not ended and are not in `steps`. They "
                      "are not admitted yet, so they have no times"),
      }));
}

}  // namespace

FormatPtr<TimelineLanes> timeline_format() {
  using View = TimelineLanes;
  static const auto format = named(
      "Timeline", "Predicted motions. Times are cell time unless noted otherwise.",
      object<View>({
          output_only("now_s", &View::now, cell_time()),
          output_only("horizon_steps", &View::horizon_steps, count(),
                      "Maximum number of admitted motions per arm, the running one included"),
          output_only("arms", &View::lanes, list(lane_format()), "Arms in the order of the cell"),
      }));
  return format;
}

}  // namespace armloom
