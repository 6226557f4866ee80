#include "core/executive/dry_run_plan.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/arms_of.h"
#include "core/executive/views.h"
#include "core/planning/answer_plan.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

constexpr auto kNoLimit = std::numeric_limits<std::size_t>::max();

}  // namespace

DryRunPlan::DryRunPlan(PlanningScenePtr scene, const CellPtr& cell,
                       const std::shared_ptr<const Policy>& policy)
    : scene_{std::move(scene)},
      cell_(*cell),
      scheduler_(cell, policy, cell_.home()),
      intake_(cell, {scheduler_, none_, tasks_, [this] { return scene_.scene; }},
              {kNoLimit, kNoLimit}),
      ahead_(intake_.ahead()),
      free_at_(cell_.arms.size(), TimePoint{}) {}

void DryRunPlan::add(const TimedJob& timed, Problems& problems) {
  JobRequest request = timed.job;
  const std::size_t index = keys_.size();
  if (request.key.empty()) request.key = "job-" + std::to_string(index + 1);
  keys_.push_back(request.key);
  request.terms.move_to_start = MoveToStart::none;  // it has to begin where the jobs before it end
  Planned job{index, request.key, request.name, timed.at, timed.at};
  const Configuration rest = ahead_.rest;
  auto prepared = intake_.prepare(std::move(request), ahead_);
  ahead_.rest = rest;
  ahead_.open.clear();
  if (!prepared) {
    return add_below("/" + std::to_string(index) + "/job", std::move(prepared.error()), problems);
  }
  for (const std::string& before : prepared->after) follow(by_key_.at(before), job);
  if (job.result || prepared->steps.empty()) {
    if (!job.result) choose(prepared->motion, scene_.scene, job);
    jobs_.push_back(std::move(job));
  } else {
    add_steps(std::move(prepared->steps), std::move(job));
  }
  by_key_.emplace(keys_.back(), jobs_.size() - 1);
}

void DryRunPlan::follow(std::size_t before, Planned& job) {
  job.after.push_back(before);
  if (jobs_[before].result) {
    job.result = {Reason::predecessor_failed, "a job in its \"after\" did not succeed"};
  } else {
    job.starts = std::max(job.starts, jobs_[before].ends());
  }
}

// Adds the motions. Each comes after the previous one, or `next` after other jobs.
void DryRunPlan::add_steps(std::vector<PreparedJob::PreparedStep> steps, Planned next) {
  TaskPreview preview(std::move(steps), scene_, ahead_.rest);
  for (std::size_t acts = 0;; acts = preview.index()) {
    const auto is_motion = preview.go_on();
    if (is_motion && !*is_motion) break;
    for (; acts < preview.index(); ++acts) {
      next.actions.push_back(preview.steps()[acts].step.request);
      const auto* wait = std::get_if<WaitRequest>(&next.actions.back().what);
      if (wait != nullptr) next.starts += wait->time;
    }
    next.step = preview.index();
    if (is_motion) {
      next.touch = preview.touch();
      choose(preview.motion(), preview.scene(), next);
    } else {
      next.result = failed_step(is_motion.error()).result;
    }
    const Planned& job = jobs_.emplace_back(std::move(next));
    if (!job.trajectory) return;
    preview.end_motion(*job.trajectory);
    next = Planned{job.job, job.key, job.name, job.asked, job.ends()};
    next.after = {jobs_.size() - 1};
  }
  scene_ = preview.scene_after();
}

void DryRunPlan::choose(const PreparedMotion& motion, const PlanningScenePtr& scene, Planned& job) {
  if (motion.goals.empty()) {
    job.trajectory = motion.alternatives.front();  // as if that were chosen
  } else {
    plan(motion.goals, scene, job);
  }
  if (job.trajectory) take(job);
}

// Plans from where the earlier jobs leave all arms, and takes the arm that arrives first.
void DryRunPlan::plan(const std::vector<MotionGoal>& goals, const PlanningScenePtr& scene,
                      Planned& job) {
  std::string why;
  TimePoint arrives = TimePoint::max();
  for (const MotionGoal& goal : goals) {
    PlanQuestion question{.goal = goal, .at = ahead_.rest, .seed = jobs_.size()};
    for (ArmId arm : all_arms(cell_)) {
      if (arm != goal.arm) question.may_move.push_back(arm);
    }
    const PlanAnswer answer = answer_plan(scene, question);
    if (!answer) {
      why += (why.empty() ? "" : "; ") + cell_.arm(goal.arm).name +
             ": no plan: " + answer.error().detail;
      continue;
    }
    const TimePoint there =
        std::max(job.starts, free_at_[goal.arm.index()]) + answer->timed.trajectory->duration();
    if (there >= arrives) continue;
    arrives = there;
    job.trajectory = answer->timed.trajectory;
  }
  if (!job.trajectory) job.result = {Reason::no_plan, why};
}

void DryRunPlan::take(Planned& job) {
  for (ArmId arm : job.trajectory->arms()) {
    job.starts = std::max(job.starts, free_at_[arm.index()]);
  }
  for (ArmId arm : job.trajectory->arms()) free_at_[arm.index()] = job.ends();
  set_joints(ahead_.rest, *job.trajectory, job.trajectory->goal());
  if (!job.step) scene_.moved(job.trajectory->arms(), {}, ahead_.rest);
}

}  // namespace armloom
