#include "server/messages/job.h"

#include <memory>

#include "server/codec/list_formats.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"
#include "server/messages/job_request.h"
#include "server/messages/job_terms.h"

namespace armloom {

using namespace formats;

namespace {

constexpr Range kShare{0.0, 1.0};

FormatPtr<Reason> reason_format() {
  return named("Reason", "A closed list; core/scheduler/README.md explains each.",
               choice<Reason>());
}

FormatPtr<JobResultView> result_format() {
  return object<JobResultView>({
      told("reason", &JobResultView::reason, reason_format()),
      told("detail", &JobResultView::detail, text()),
  });
}

FormatPtr<ChoiceView> choice_format() {
  return object<ChoiceView>({
      told("candidates", &ChoiceView::candidates, list(text()),
           "Jobs that could have taken the turn, or arms that could have done it: as it was first"),
      told("selected", &ChoiceView::selected, text(), "One of these"),
      told("time_saved_s", &ChoiceView::time_saved_s, nullable(number(kAnyNumber)),
           "By so much the plan costs less than with the first, or a goal's job arrives sooner; "
           "null: that is taken, or could not go"),
      told("detail", &ChoiceView::detail, text()),
  });
}
FormatPtr<AnotherWayView> another_way_format() {
  using View = AnotherWayView;
  using Cause = AnotherWay::Cause;
  return object<View>({
      told("done", &View::done, count(), "So many times it was given another way"),
      told("planning", &View::is_open, flag(), "One is being looked for: it stays where it is"),
      told("cause", &View::cause, choice<Cause>(),
           "Of the last time: POST /jobs/{id}/replan, on_timeout, or on_idle_blocker"),
      told("refused", &View::refusal, nullable(text()), "Why it kept its own, the last time"),
  });
}
FormatPtr<DetourView> detour_format() {
  return object<DetourView>({
      told("candidates_evaluated", &DetourView::candidates_evaluated, count(),
           "So many ways around"),
      told("selected", &DetourView::is_selected, flag(), "It goes by one of them"),
      told("time_saved_s", &DetourView::time_saved_s, nullable(number(kPositive)),
           "By so much sooner it arrives by that, as it was predicted; null: none is taken, or the "
           "shortest way could not go as things stood"),
  });
}
std::optional<std::vector<std::string>> alternatives_of(const JobWaysView& ways) {
  return ways.alternatives.empty() ? std::nullopt : std::optional(ways.alternatives);
}

std::optional<std::string> detail_of(const WaitView& wait) {
  return wait.detail.empty() ? std::nullopt : std::optional(wait.detail);
}

PartPtr<CheckView> make_verdict_part() {
  using View = CheckView;
  using Kind = Verdict::Kind;
  return parts<View>({
      told("verdict", &View::kind, choice<Kind>()),
      told("earliest_start_s", &View::earliest_start_s, nullable(number({0.0})),
           "From now; 0 where it would start at once, null when not known"),
      told("clearance_bound_m", &View::clearance_bound_m, nullable(number(kAnyNumber)),
           "What is proven to be kept between arms, and by arms from what stands still: the least "
           "that any such pair was held to"),
      told("self_clearance_bound_m", &View::self_clearance_bound_m, nullable(number(kAnyNumber)),
           "The same of the links of one arm from each other"),
      told("waits_on", &View::waits_on, list(wait_format()),
           "As the job's own would be: of a free one, what it would wait for before it starts"),
      told("conflicts", &View::conflicts, list(wait_format()), "The same, where it is not free"),
      told("evaluations", &View::evaluations, count()),
      told("scene_version", &View::scene_version, count()),
      told_if("choice", &View::choice, choice_format(),
              "Of a goal that several arms could go to: which one would"),
      told_if("move_to_start_s", &View::move_to_start_s, number({0.0}),
              "Of a job that asks for an approach: so long its arms would take to where it begins. "
              "The verdict is of that motion; where it would not be admitted together with it, the "
              "job is judged again when it is there"),
      told_if("result", &View::result, result_format(), "It would end at once, without moving"),
  });
}

PartPtr<JobTimesView> times_part() {
  return parts<JobTimesView>({
      told_times("submitted", &JobTimesView::submitted_at, "When it was accepted"),
      told_if("backlogged_s", &JobTimesView::backlogged_at, cell_time(),
              "When it first was found in conflict, in cell time; absent: never"),
      told_if("expires_s", &JobTimesView::expires_at, cell_time(),
              "When it is given up if nothing changes, in cell time: while it waits in the "
              "backlog, or on its path for what no job moves"),
      told_times("scheduled", &JobTimesView::scheduled_at, "When it starts; null: not planned"),
      told_times("started", &JobTimesView::started_at, "When it began to move; null: not yet"),
      told_times("ended", &JobTimesView::ended_at, "When it ended; null: not yet"),
  });
}

PartPtr<JobMotionView> motion_part() {
  return parts<JobMotionView>({
      told("progress", &JobMotionView::progress, number(kShare), "Share of the trajectory's time"),
      told("duration_s", &JobMotionView::duration, seconds(kPositive), "Of the trajectory"),
      told_if("planned", &JobMotionView::planned, flag(),
              "Of a goal: whether its way is planned; until then duration_s is an "
              "estimate"),
      told("stopping", &JobMotionView::stopping, flag(), "Brakes on its path"),
  });
}

PartPtr<JobWaysView> ways_part() {
  return parts<JobWaysView>({
      told_if("alternatives", alternatives_of, list(text()),
              "Arms of which one does it; `arms` is that one, or the likeliest "
              "while it waits"),
      told_if("replan", &JobWaysView::another_way, another_way_format(),
              "Other ways that were looked for, to where its own ends"),
      told_if("detour", &JobWaysView::detour, detour_format(),
              "Of a goal whose shortest way would have to wait: ways around what "
              "others hold"),
      told_if("choice", &JobWaysView::choice, choice_format(),
              "Why it was taken before others, or by this arm"),
  });
}

}  // namespace

FormatPtr<JobState> job_state_format() {
  static const auto format =
      named("JobState", "The last five are terminal: a job reaches exactly one of them.",
            choice<JobState>());
  return format;
}

FormatPtr<WaitView> wait_format() {
  using Kind = Wait::Kind;
  static const auto format =
      named("Wait", "What a job waits for, with the evidence.",
            object<WaitView>({
                told("kind", &WaitView::kind, choice<Kind>()),
                told("id", &WaitView::job, text_or_null(), "The other job"),
                told("arm", &WaitView::arm, text_or_null(), "The other arm"),
                told("links", &WaitView::links, list(text(), {.most = 2}),
                     "Own link, then the other's, or an object; empty without evidence"),
                told("own_time_s", &WaitView::own_time_s, nullable(number(kAnyNumber)),
                     "From the start of this trajectory"),
                told("other_time_s", &WaitView::other_time_s, nullable(number(kAnyNumber)),
                     "From the start of the other's"),
                told("clearance_m", &WaitView::clearance_m, nullable(number(kAnyNumber)),
                     "Distance found; zero or less in contact"),
                told_if("detail", detail_of, text(), "Of a stop: its cause"),
                told_if("progress", &WaitView::progress, number(kShare),
                        "Of a check: the share of its budget that it has used; most end early"),
            }));
  return format;
}

FormatPtr<JobView> job_format() {
  using View = JobView;
  static const auto format = named(
      "Job", "A job as the server gives it.",
      object<View>({
          told("id", &View::key, job_id_format()),
          told("name", &View::name, text(), "For people; may be empty"),
          told("state", &View::state, job_state_format()),
          told("arms", &View::arms, list(text()), "That it moves"),
          inlined(&View::terms, job_terms_part()),
          inlined(&View::times, times_part()),
          inlined(&View::motion, motion_part()),
          told("waits_on", &View::waits_on, list(wait_format()), "Empty when it does not wait"),
          inlined(&View::ways, ways_part()),
          told("cycle", &View::cycle, list(text()),
               "The deadlock that it is part of, itself first: each waits for the next one, the "
               "last for the first. Else empty"),
          told("result", &View::result, nullable(result_format()), "null until terminal"),
      }));
  return format;
}

const PartPtr<CheckView>& verdict_part() {
  static const auto part = make_verdict_part();
  return part;
}

FormatPtr<CheckView> verdict_format() {
  static const auto format =
      named("Verdict", "The answer of the admission code to: what if this job came now?",
            object<CheckView>({make_verdict_part()}));
  return format;
}

}  // namespace armloom
