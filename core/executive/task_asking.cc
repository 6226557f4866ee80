// Answers queries about jobs with steps: plans and checks.
#include <algorithm>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/arms_of.h"
#include "core/executive/inquiry_desk.h"
#include "core/executive/start_elsewhere.h"
#include "core/executive/task_preview.h"
#include "core/executive/task_view.h"
#include "core/executive/views.h"

namespace armloom {

// ---- Plans ----

namespace {

// Returns the JSON pointer of a trajectory in its step.
std::string place_of_motion(const StepRequest& step) {
  const auto* motion = std::get_if<MotionStepRequest>(&step.what);
  if (motion == nullptr) return "";
  return motion->trajectory.place.value_or("/trajectory");
}

}  // namespace

struct InquiryDesk::OpenStepsPlan {
  StepsInquiry inquiry;
  TaskPreview preview;
  std::vector<ArmId> arms;  // of the task: they stay where its steps leave them
  std::shared_ptr<std::atomic<bool>> cancelled;
  std::function<void(Result<StepsPlan>)> done;
  StepsPlan plan = {};

  [[nodiscard]] const StepRequest& request() const {
    return preview.steps()[preview.index()].step.request;
  }
  // Adds the actions before the present step.
  void add_actions() {
    while (plan.steps.size() < preview.index()) {
      add(preview.steps()[plan.steps.size()].step.request);
    }
  }
  PlannedStep& add(const StepRequest& step) {
    return plan.steps.emplace_back(
        PlannedStep{.name = step.name, .kind = kind_of(step), .detail = text_of(step)});
  }
  void add_motion(const Cell& cell, TrajectoryPtr motion, std::uint64_t evaluations) {
    PlannedStep& step = add(request());
    step.arms = each_name(cell, motion->arms());
    step.evaluations = evaluations;
    preview.end_motion(*motion);
    step.motion = std::move(motion);
  }
  void end() { done(std::move(plan)); }
  void refuse(Problems problems) {
    plan.refused = std::move(problems);
    end();
  }
  void refuse(PlanRefusal why);
};

void InquiryDesk::OpenStepsPlan::refuse(PlanRefusal why) {
  const std::string place = place_of_step(preview.index());
  const auto& motion = std::get<MotionStepRequest>(request().what);
  RefusedInquiry refused{std::move(why), place};
  const bool is_of_start = refused.why.is_of_start();
  if (is_of_start) refused.value = motion.arm;
  const bool is_of_goal = !is_of_start && refused.why.reason != PlanRefusal::Reason::not_found &&
                          refused.why.reason != PlanRefusal::Reason::cancelled;
  if (is_of_goal) point_at_goal(place + "/move_to", *motion.move_to, refused);
  plan.refused = std::move(refused);
  end();
}

void InquiryDesk::plan(StepsInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
                       std::function<void(Result<StepsPlan>)> done) {
  JobIntake::Ahead ahead = intake_.ahead();
  const Configuration at = ahead.rest;
  auto prepared = intake_.prepare(inquiry.job, ahead);
  if (!prepared) return done(failure(std::move(prepared.error())));
  std::vector<ArmId> arms = armloom::arms_of(prepared->steps);
  plan_next(std::make_shared<OpenStepsPlan>(
      OpenStepsPlan{std::move(inquiry),
                    TaskPreview(std::move(prepared->steps), {scene_.scene(), touch_left_}, at),
                    std::move(arms), std::move(cancelled), std::move(done)}));
}

void InquiryDesk::plan_next(const std::shared_ptr<OpenStepsPlan>& open) {
  const auto arrived = [this, open](Result<bool> is_motion) {
    open->add_actions();
    if (!is_motion) return open->refuse(std::move(is_motion.error()));
    if (!*is_motion) return open->end();
    plan_motion(open);
  };
  if (!go_on(open->preview, open, arrived)) open->done(failure(too_many_open("plans")));
}

// Plans the present motion.
void InquiryDesk::plan_motion(const std::shared_ptr<OpenStepsPlan>& open) {
  const TaskPreview& preview = open->preview;
  const PreparedMotion& motion = preview.motion();
  if (motion.goals.empty()) {
    const TrajectoryPtr given = motion.alternatives.front();
    Problems elsewhere, problems;
    find_start_elsewhere(*cell_, *given, preview.at(), elsewhere);
    add_below(place_of_step(preview.index()) + place_of_motion(open->request()),
              std::move(elsewhere), problems);
    if (!problems.empty()) return open->refuse(std::move(problems));
    open->add_motion(*cell_, given, 0);
    return plan_next(open);
  }
  PlanQuestion question{.goal = motion.goals.front(),
                        .at = preview.at(),
                        .may_move = may_move(open->arms),
                        .seed = open->inquiry.seed,
                        .budget = open->inquiry.budget};
  const auto answered = [this, open](PlanAnswer answer) {
    if (!answer) return open->refuse(std::move(answer.error()));
    open->add_motion(*cell_, answer->timed.trajectory, answer->way.evaluations);
    plan_next(open);
  };
  PlanTask task{std::move(question), preview.scene(), open->cancelled, answered};
  if (questions_.service().draft(std::move(task))) return;
  open->done(failure(too_many_open("plans")));
}

// Goes on to the next motion of the preview, which `owner` owns. Makes the scenes on a worker: each
// costs up to some milliseconds. `arrived` is called on the strand. Returns false if too many
// questions are open.
bool InquiryDesk::go_on(TaskPreview& preview, std::shared_ptr<void> owner,
                        std::function<void(Result<bool>)> arrived) {
  const auto found = std::make_shared<Result<bool>>(false);
  return questions_.service().compute(
      [&preview, owner, found] { *found = preview.go_on(); },
      [owner, found, arrived = std::move(arrived)] { arrived(std::move(*found)); });
}

// ---- Checks ----

struct InquiryDesk::OpenStepsCheck {
  PreparedJob job;
  TaskPreview preview;
  std::vector<ArmId> arms;  // of the task
  std::function<void(Result<CheckView>)> done;
  CheckView view;  // of the motions so far
  bool is_first = true;
};

void InquiryDesk::check_steps(PreparedJob job, Configuration at,
                              std::function<void(Result<CheckView>)> done) {
  TaskPreview preview(job.steps, {scene_.scene(), touch_left_}, std::move(at));
  std::vector<ArmId> arms = armloom::arms_of(job.steps);
  CheckView view{.scene_version = scene_.version()};
  check_next(std::make_shared<OpenStepsCheck>(OpenStepsCheck{
      std::move(job), std::move(preview), std::move(arms), std::move(done), std::move(view)}));
}

void InquiryDesk::check_next(const std::shared_ptr<OpenStepsCheck>& open) {
  const auto arrived = [this, open](const Result<bool>& is_motion) {
    if (!is_motion) {
      add_step(open->view, failed_step(is_motion.error()), open->preview.index(), open->is_first);
    }
    if (!is_motion || !*is_motion) return open->done(std::move(open->view));
    const auto judged = [this, open](TrialEnd end) {
      if (!end) return open->done(failure(std::move(end.error())));
      add_step(open->view, view_of(*end, *cell_, jobs_), open->preview.index(), open->is_first);
      if (open->view.kind != Verdict::Kind::free) return open->done(std::move(open->view));
      open->is_first = false;
      open->preview.end_motion(*end->step->trajectory);
      check_next(open);
    };
    walk(std::make_shared<Trial>(trial_of(*open)), open->preview.scene(), judged);
  };
  if (!go_on(open->preview, open, arrived)) open->done(failure(too_many_open("checks")));
}

// The first motion is submitted as the job would be. A further motion is submitted when the arms of
// the job are where the motion before leaves them.
Trial InquiryDesk::trial_of(const OpenStepsCheck& open) {
  const TaskPreview& preview = open.preview;
  Scheduler scheduler = open.is_first
                            ? scheduler_
                            : with_arms_at(scheduler_, cell_, open.arms, preview.at(), clock_.now);
  SceneChanged scene{{}, shared_holds(*cell_, hands_of(*preview.scene()))};
  const bool is_present = scene.shared_holds == scheduler.state().around.shared_holds;
  if (!is_present) (void)scheduler.step(std::move(scene), clock_.now);
  const auto before = open.is_first ? std::nullopt : std::optional(JobId{0});
  Submit asked = intake_.submission(open.job, preview.motion(), before);
  asked.job = scheduler.next_job();
  if (!open.is_first) asked.after.clear();  // they have ended
  std::vector<Submit> behind;
  for (std::size_t i = preview.index() + 1; i < preview.steps().size(); ++i) {
    const PreparedJob::PreparedStep& step = preview.steps()[i];
    if (!step.motion) continue;
    behind.push_back(intake_.submission(open.job, *step.motion, asked.job));
    behind.back().awaits_actions = step.step.is_awaited;
  }
  return {std::move(scheduler),
          open.is_first && is_present ? open_now() : Trial::Open{},
          {asked},
          asked.job,
          clock_.now,
          std::move(behind)};
}

}  // namespace armloom
