#include "core/scheduler/goals.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/jobs/phases.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// It was asked for, or made, for where the arm will be and for the scene as it is.
bool fits(const State& state, const JobGoal& goal, const Eigen::VectorXd& stands) {
  if (goal.from.size() != stands.size() || goal.asked_at < state.recheck_epoch) return false;
  const double off = (goal.from - stands).cwiseAbs().maxCoeff();
  return off <= state.cell->execution.start_tolerance_rad;
}

// In its turn: all that came before it is done, and its own arm is where the job finds it.
PlanQuestion question_about(const State& state, const Record& record, Configuration at) {
  const ArmId own = record.job.goal->goal.arm;
  PlanQuestion question{.goal = record.job.goal->goal, .seed = record.job.id.value()};
  const JobId turn = record.errand.before ? state.jobs.at(*record.errand.before).turn : record.turn;
  for (std::uint32_t a = 0; a < state.cell->arms.size(); ++a) {
    const ArmId arm{a};
    if (arm == own) continue;
    question.may_move.push_back(arm);
    for (JobId id : state.jobs.queues()[arm]) {
      const Record& other = state.jobs.at(id);
      if (other.turn < turn && !other.job.is_unplanned()) {
        follow_to_end(at, *state.cell, arm, *other.job.trajectory);
      }
    }
  }
  question.at = std::move(at);
  return question;
}

void ask(State& state, Record& record, const Configuration& at) {
  JobGoal& goal = *record.job.goal;
  if (std::exchange(goal.is_planned, false)) {
    state.lanes.forget_passages();
    state.lanes.renew_later();
    ++state.version;
  }
  goal.refusal.reset();
  ++goal.tries;
  goal.question = ++record.asking.plans;
  goal.asked_at = state.version;
  goal.from = joints_of(at, state.cell->arm(goal.goal.arm).joints);
  state.decided.effects.push_back(
      PlanMotion{record.job.id, *goal.question, question_about(state, record, at)});
}

// The first of the arm's jobs that is to fail, with its refusal; null: none.
Record* plan_lane(State& state, ArmId arm) {
  const auto& queue = state.jobs.queues()[arm];
  Configuration at = state.arms.rest();
  for (std::size_t i = 0; i < std::min(queue.size(), kPlannedAhead); ++i) {
    Record& record = state.jobs.at(queue[i]);
    Job& job = record.job;
    if (job.goal && job.in<Queued>() != nullptr) {
      JobGoal& goal = *job.goal;
      // What comes of it is seen when it is answered.
      if (goal.question || job.is_replanned_now()) return nullptr;
      const bool is_fit = fits(state, goal, joints_of(at, state.cell->arm(arm).joints));
      if (is_fit && goal.refusal) return &record;
      if (is_fit && goal.is_planned) {
        goal.tries = 0;
      } else if (goal.tries >= kPlansMax) {
        goal.refusal = "planned " + std::to_string(kPlansMax) +
                       " times, and each time the arm or the scene was another one by then";
        return &record;
      } else {
        ask(state, record, at);
        return nullptr;
      }
    }
    follow_to_end(at, *state.cell, arm, *job.trajectory);
  }
  return nullptr;
}

}  // namespace

bool plan_goals(State& state) {
  bool any_failed = false;
  if (!state.jobs.has_goals()) return any_failed;
  for (std::uint32_t arm = 0; arm < state.cell->arms.size(); ++arm) {
    while (Record* record = plan_lane(state, ArmId{arm})) {
      Record* helped = record->errand.before ? state.jobs.find(*record->errand.before) : nullptr;
      if (helped != nullptr) helped->approaches.refusal = record->job.goal->refusal;
      end(state, *record, JobState::failed, Reason::no_plan, *record->job.goal->refusal);
      any_failed = true;
    }
  }
  return any_failed;
}

void take_plan(State& state, const PlanMade& answer) {
  Record* record = state.jobs.find(answer.job);
  if (record == nullptr || record->job.has_ended() || !record->job.goal) return;
  JobGoal& goal = *record->job.goal;
  if (goal.question != answer.question) return;
  goal.question.reset();
  if (answer.trajectory) {
    goal.is_planned = true;
    state.jobs.set_motion(*record, answer.trajectory,
                          state.arms.leg_of(*state.cell, answer.job, *answer.trajectory));
    state.lanes.renew_later();
    ++state.version;
  } else {
    goal.refusal = answer.why;
  }
}

}  // namespace armloom
