#include "server/messages/job.h"

#include <memory>

#include "server/codec/list_formats.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/job_request.h"
#include "server/messages/job_terms.h"

namespace armloom {

using namespace formats;

namespace {

constexpr Range kShare{0.0, 1.0};

FormatPtr<Reason> reason_format() {
  return named("Reason", "Why a job ended. core/scheduler/README.md explains each reason.",
               choice<Reason>());
}

FormatPtr<JobResultView> result_format() {
  return object<JobResultView>({
      output_only("reason", &JobResultView::reason, reason_format()),
      output_only("detail", &JobResultView::detail, text()),
      output_if("step", &JobResultView::step, count(),
                "Of a job with steps that did not succeed: index of the step at which it ended"),
  });
}

std::optional<std::vector<StepView>> steps_of(const JobView& job) {
  return job.steps.empty() ? std::nullopt : std::optional(job.steps);
}

FormatPtr<StepView> step_format() {
  using View = StepView;
  return named(
      "Step", "A step of a job.",
      object<View>({
          output_only("name", &View::name, text(), "Display name; may be empty"),
          output_only(
              "kind", &View::kind, text(),
              "The member that names the step: trajectory, move_to, gripper, attach, detach, "
              "wait_s, set_io or wait_io"),
          output_only("state", &View::state, choice<StepState>()),
          output_only("detail", &View::detail, text(), "What the step does; may be empty"),
          output_only("arms", &View::arms, list(text()), "Arms that a motion moves"),
          output_only("progress", &View::progress, number(kShare), "Progress of a motion"),
      }));
}

FormatPtr<ChoiceView> choice_format() {
  return object<ChoiceView>({
      output_only(
          "candidates", &ChoiceView::candidates, list(text()),
          "Jobs that could have gone first, or arms that could have done the job, when the choice "
          "was first made"),
      output_only("selected", &ChoiceView::selected, text(), "The selected candidate"),
      output_only("time_saved_s", &ChoiceView::time_saved_s, nullable(number(kAnyNumber)),
                  "Time saved compared with the first candidate: lower plan cost, or for a goal "
                  "earlier arrival. null if the first candidate is selected or could not go"),
      output_only("detail", &ChoiceView::detail, text()),
  });
}
FormatPtr<StarvationView> starvation_format() {
  using View = StarvationView;
  return object<View>({
      output_only("waits_since_s", &View::waits_since, cell_time(),
                  "Cell time since which the job is the first of its arms and was not admitted"),
      output_only("bound_s", &View::bound_s, number({0.0}),
                  "`aging_s` of the cell: the job is flagged if it is overtaken after this time"),
      output_only("overtaken_by", &View::overtaken_by, count(),
                  "Number of jobs, submitted later, that were admitted since then"),
  });
}
FormatPtr<AnotherWayView> another_way_format() {
  using View = AnotherWayView;
  using Cause = AnotherWay::Cause;
  return object<View>({
      output_only("done", &View::done, count(), "Number of successful replans"),
      output_only("planning", &View::is_open, flag(),
                  "true while a path is being planned; the arm waits on its path"),
      output_only(
          "cause", &View::cause, choice<Cause>(),
          "Cause of the last replan: POST /jobs/{id}/replan, on_timeout, or on_idle_blocker"),
      output_only("refused", &View::refusal, nullable(text()),
                  "Reason why the last replan failed and the job kept its path; else null"),
  });
}
FormatPtr<DetourView> detour_format() {
  return object<DetourView>({
      output_only("candidates_evaluated", &DetourView::candidates_evaluated, count(),
                  "Number of detours evaluated"),
      output_only("selected", &DetourView::is_selected, flag(), "true if the job takes a detour"),
      output_only("time_saved_s", &DetourView::time_saved_s, nullable(number(kPositive)),
                  "Time by which the detour is predicted to arrive earlier. null if no detour is "
                  "selected, or if the shortest path was blocked"),
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
      output_only("verdict", &View::kind, choice<Kind>()),
      output_only("earliest_start_s", &View::earliest_start_s, nullable(number({0.0})),
                  "Delay until the earliest start; 0 for an immediate start, null if unknown"),
      output_only("clearance_bound_m", &View::clearance_bound_m, nullable(number(kAnyNumber)),
                  "Certified clearance between arms, and between arms and objects: the smallest "
                  "clearance required of any such pair"),
      output_only("self_clearance_bound_m", &View::self_clearance_bound_m,
                  nullable(number(kAnyNumber)), "Certified clearance between links of one arm"),
      output_only(
          "waits_on", &View::waits_on, list(wait_format()),
          "What the job would wait for; a job with verdict `free` may still wait before it starts"),
      output_only("conflicts", &View::conflicts, list(wait_format()),
                  "Conflicts found, in the form of `waits_on`; empty if `verdict` is `free`"),
      output_only("evaluations", &View::evaluations, count()),
      output_only("scene_version", &View::scene_version, count()),
      output_if("choice", &View::choice, choice_format(),
                "For a goal with several candidate arms: the arm that would be selected"),
      output_if("move_to_start_s", &View::move_to_start_s, number({0.0}),
                "For a job with `move_to_start`: duration of the motion to its start. The verdict "
                "covers that motion. If the job cannot be admitted together with that motion, it "
                "is checked again at its start"),
      output_if("result", &View::result, result_format(),
                "Result of a job that would end at once without moving. Of a job with steps: its "
                "result if it would end before the motion of `step`"),
      output_if("step", &View::step, count(),
                "Only of a job with steps that is not `free`: index of the first step that is not. "
                "`verdict`, `waits_on`, `conflicts` and `result` are those of this step"),
  });
}

PartPtr<JobTimesView> times_part() {
  return parts<JobTimesView>({
      output_times("submitted", &JobTimesView::submitted_at, "Time of acceptance"),
      output_if("backlogged_s", &JobTimesView::backlogged_at, cell_time(),
                "Cell time of the first conflict; absent if there was none"),
      output_if("expires_s", &JobTimesView::expires_at, cell_time(),
                "Cell time at which the job expires if nothing changes. Present while the job "
                "waits in the backlog, or waits on its path for something that no job moves"),
      output_times("scheduled", &JobTimesView::scheduled_at,
                   "Scheduled start; null if not scheduled"),
      output_times("started", &JobTimesView::started_at, "Start of motion; null before it"),
      output_times("ended", &JobTimesView::ended_at, "End; null before it"),
  });
}

std::optional<bool> is_estimate(const JobMotionView& motion) {
  return motion.planned && !*motion.planned ? std::optional(true) : std::nullopt;
}

PartPtr<JobMotionView> motion_part() {
  return parts<JobMotionView>({
      output_only("progress", &JobMotionView::progress, number(kShare),
                  "Share of the trajectory's time, 0 to 1"),
      output_only("duration_s", &JobMotionView::duration, seconds(kPositive),
                  "Duration of the trajectory, velocity scaling included"),
      output_if(
          "duration_is_estimate", is_estimate, flag(),
          "true if `duration_s` is an estimate, because the path to the goal is not planned yet: "
          "the straight line in joint space at this velocity scaling"),
      output_if("velocity_scaling_factor", &JobMotionView::velocity_scaling, number(kShare),
                "For a goal: share of the maximum velocity"),
      output_if("planned", &JobMotionView::planned, flag(),
                "For a goal: true if the path is planned"),
      output_if("retimed", &JobMotionView::retimed, flag(),
                "true if the server computed the times of the trajectory (`retime`)"),
      output_only("stopping", &JobMotionView::stopping, flag(),
                  "true while the job brakes on its path"),
  });
}

PartPtr<JobWaysView> ways_part() {
  return parts<JobWaysView>({
      output_if("alternatives", alternatives_of, list(text()),
                "Candidate arms; `arms` has the selected arm, or the most likely one while the job "
                "waits"),
      output_if("replan", &JobWaysView::another_way, another_way_format(), "Replans of the job"),
      output_if("detour", &JobWaysView::detour, detour_format(),
                "Present for a goal whose shortest path would have to wait: detours around the "
                "motions of other arms"),
      output_if("choice", &JobWaysView::choice, choice_format(),
                "Why this job went before others, or why this arm was selected"),
  });
}

}  // namespace

FormatPtr<JobState> job_state_format() {
  static const auto format = named(
      "JobState",
      "State of a job. The last five states are terminal; every job reaches exactly one of them.",
      choice<JobState>());
  return format;
}

FormatPtr<WaitView> wait_format() {
  using Kind = Wait::Kind;
  static const auto format = named(
      "Wait", "A reason to wait, with the evidence.",
      object<WaitView>({
          output_only("kind", &WaitView::kind, choice<Kind>()),
          output_only("id", &WaitView::job, text_or_null(),
                      "Id of the other job; for kind io the name of the signal"),
          output_only("arm", &WaitView::arm, text_or_null(), "Name of the other arm"),
          output_only(
              "links", &WaitView::links, list(text(), {.most = 2}),
              "Link of this job's arm, then the other link or object; empty without evidence"),
          output_only(
              "own_time_s", &WaitView::own_time_s, nullable(number(kAnyNumber)),
              "Time of the conflict from the start of this trajectory. For kind predecessor "
              "the end of the trajectory, if this job would end in the path of that job"),
          output_only("other_time_s", &WaitView::other_time_s, nullable(number(kAnyNumber)),
                      "Time of the conflict from the start of the other trajectory"),
          output_only("clearance_m", &WaitView::clearance_m, nullable(number(kAnyNumber)),
                      "Distance found; zero or negative in contact"),
          output_if("detail", detail_of, text(),
                    "Details, for example the cause of a stop, or why a predecessor goes first"),
          output_if("progress", &WaitView::progress, number(kShare),
                    "While the job is being checked: share of the limit of evaluations used so "
                    "far. Most checks end before the limit"),
      }));
  return format;
}

FormatPtr<JobView> job_format() {
  using View = JobView;
  static const auto format =
      named("Job", "A job with its present state.",
            object<View>({
                output_only("id", &View::key, job_id_format()),
                output_only("name", &View::name, text(), "Display name; may be empty"),
                output_only("state", &View::state, job_state_format()),
                output_only("arms", &View::arms, list(text()), "Arms that the job moves"),
                inlined(&View::terms, job_terms_part()),
                inlined(&View::times, times_part()),
                inlined(&View::motion, motion_part()),
                output_if("steps", steps_of, list(step_format()), "Only of a job with steps"),
                output_if("step", &View::step, count(),
                          "Only of a job with steps: index of the present step"),
                output_only("waits_on", &View::waits_on, list(wait_format()),
                            "Reasons to wait; empty if the job does not wait. Of a job that has "
                            "expired: what it waited for"),
                inlined(&View::ways, ways_part()),
                output_if("starvation", &View::starvation, starvation_format(),
                          "Present if the job starves: it has waited longer than `aging_s` while "
                          "jobs that were submitted later went first"),
                output_only("cycle", &View::cycle, list(text()),
                            "Ids of the jobs in the deadlock cycle that contains this job, this "
                            "job first. Each job waits for the next, and the last for the first. "
                            "Empty if the job is in no cycle"),
                output_only("result", &View::result, nullable(result_format()),
                            "Result of an ended job; else null"),
                output_if("notice", &View::notice, text(),
                          "Only in the answer to PATCH: why the change has no effect at present"),
            }));
  return format;
}

const PartPtr<CheckView>& verdict_part() {
  static const auto part = make_verdict_part();
  return part;
}

FormatPtr<CheckView> verdict_format() {
  static const auto format =
      named("Verdict", "The result of checking a job as if it were submitted now.",
            object<CheckView>({make_verdict_part()}));
  return format;
}

}  // namespace armloom
