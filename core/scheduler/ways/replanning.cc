#include "core/scheduler/ways/replanning.h"

#include <algorithm>
#include <utility>

#include "core/jobs/standing.h"
#include "core/jobs/waits.h"
#include "core/scheduler/motion_questions.h"
#include "core/scheduler/rejoining.h"
#include "core/scheduler/ways/approach.h"
#include "core/scheduler/ways/path_requests.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Lowest speed, as a share of the limits, with which a path is planned.
constexpr double kSlowest = 0.01;
// Seeds of further tries differ from those of other jobs.
constexpr std::uint64_t kSeedsOfOneTry = std::uint64_t{1} << 32;

ArmId arm_of(const Step& step) { return step.trajectory->arms().front(); }

// Returns the largest share of a speed limit that the motion uses.
double speed_of(const Cell& cell, const Trajectory& motion) {
  double share = kSlowest;
  for (const SegmentBounds& bounds : motion.bounds()) {
    for (std::size_t j = 0; j < motion.joints().size(); ++j) {
      const double speed = bounds.speed[static_cast<Eigen::Index>(j)];
      share = std::max(share, speed / cell.joint(motion.joints()[j]).velocity_max);
    }
  }
  return std::min(share, 1.0);
}

// Keeps the joint positions of the end if another job begins there, and a straight line.
MotionGoal goal_of(const State& state, const Step& step, Configuration end) {
  const ArmId arm = arm_of(step);
  const bool is_last = state.jobs.queues()[arm].back() == step.id;
  if (step.goal && (is_last || step.goal->way().goal.straight)) return step.goal->way().goal;
  follow_to_end(end, *state.cell, arm, *step.trajectory);
  return {
      .arm = arm,
      .to = joints_of(end, state.cell->arm(arm).joints),
      .speed = step.goal ? step.goal->way().goal.speed : speed_of(*state.cell, *step.trajectory)};
}

PlanQuestion question_about(const State& state, const Step& step) {
  const Configuration at = rest_after_admitted(state, &step);
  PlanQuestion question{.goal = goal_of(state, step, at),
                        .at = at,
                        .seed = step.id.job.value() + kSeedsOfOneTry * step.plans.sent()};
  if (step.another_way->cause != AnotherWay::Cause::client)
    return question;  // the path leads around them all
  for (std::uint32_t arm = 0; arm < state.cell->arms.size(); ++arm) {
    const bool moves = ArmId{arm} != question.goal.arm && !state.jobs.queues()[ArmId{arm}].empty();
    if (moves) question.may_move.push_back(ArmId{arm});
  }
  return question;
}

bool is_same_place(const State& state, const Configuration& a, const Configuration& b) {
  return a.size() == b.size() &&
         (a - b).cwiseAbs().maxCoeff() <= state.cell->execution.start_tolerance_rad;
}

// Returns true if the arm still rests where the new path begins, in the same scene.
bool fits(const State& state, const Step& step) {
  const AnotherWay& other = *step.another_way;
  const auto& joints = state.cell->arm(arm_of(step)).joints;
  const Eigen::VectorXd from = joints_of(other.request.beside, joints);
  const Eigen::VectorXd stands = joints_of(rest_after_admitted(state, &step), joints);
  return other.request.asked_at >= state.around.scene_since && is_same_place(state, from, stands);
}

void ask_at_rest(Transitions& state, const Step& step) {
  if (!step.is_waiting() || step.plans.is_open(ForReplan{})) return;
  AnotherWay other = *step.another_way;
  other.request =
      send(state, step, ForReplan{}, std::move(other.request), question_about(state, step));
  state.jobs().set(step, std::move(other));
}

}  // namespace

std::optional<std::string> why_not_replanned(const Step& step) {
  if (step.trajectory->arms().size() > 1) return "it moves several arms together";
  if (step.goal) return std::nullopt;
  if (!step.alternatives.empty()) return "it has several alternatives";
  const bool is_loop = step.trajectory->start().isApprox(step.trajectory->goal());
  if (!is_loop) return std::nullopt;
  return "it ends where it begins, so a new path would drop all of its motion";
}

void ask_for_another_way(Transitions& state, const Step& step, AnotherWay::Cause cause) {
  if (step.is_unplanned() || step.is_replanned_now()) return;
  if (step.has_open_arm()) state.jobs().decide_arm(step);
  AnotherWay other = step.another_way.value_or(AnotherWay{});
  other.cause = cause;
  if (cause == AnotherWay::Cause::client) other.request.tries = 0;
  other.is_open = true;
  other.refusal.reset();
  state.jobs().set(step, std::move(other));
  if (step.has_authority()) state.brake(step, {});
  ask_at_rest(state, step);
}

void plan_other_ways(Transitions& state) {
  for (JobId id : std::set<JobId>(state->jobs.being_replanned())) {
    const Step& step = state->jobs.at(id);
    if (step.in<Admitted>() != nullptr) state.brake(step, {});  // it had not moved
    ask_at_rest(state, step);
  }
}

bool take_other_way(Transitions& state, const Step& step, const PlanMade& answer) {
  AnotherWay other = *step.another_way;
  if (!other.is_open || !step.is_waiting()) return false;  // if it is braking, it asks again
  const bool is_fit = fits(state, step);
  if (!is_fit && other.request.tries < kReplansMax) {
    ask_at_rest(state, step);
    return false;
  }
  other.is_open = false;
  const bool is_taken = answer.trajectory && is_fit;
  if (is_taken) {
    ++other.done;
  } else {
    other.refusal = is_fit ? answer.none.why
                           : "plan was out of date: the arm had moved or the scene had changed";
  }
  state.jobs().set(step, other);
  if (is_taken) {
    state.set_out_anew(step, answer.trajectory);
    if (step.goal) {  // it is the plan to its goal from now on
      GoalWay way = step.goal->way();
      way.request.beside = other.request.beside;
      way.request.asked_at = other.request.asked_at;
      state.jobs().set(step, step.goal->taken, std::move(way));
      state.jobs().set(step, std::optional<Detour>());
    }
  } else if (other.cause == AnotherWay::Cause::timeout) {
    expire(state, step, "; no other path: " + *other.refusal);
  } else if (auto beside = rest_beside_path(state, step)) {  // it cannot go on from there
    state.give_up(step, {AfterStop::Then::fail, Reason::start_mismatch,
                         *beside + "; no path from there: " + *other.refusal});
  }
  return is_taken;
}

bool may_go_around(const State& state, const Step& step) {
  if (state.cell->scheduling.on_idle_blocker != OnIdleBlocker::replan) return false;
  if (step.is_unplanned() || why_not_replanned(step)) return false;
  if (step.is_replanned_now()) return true;
  if (!step.is_waiting() && !step.pausing()) return false;
  if (!step.another_way) return true;
  const bool is_as_tried =
      step.another_way->request.asked_at >= state.around.scene_since &&
      is_same_place(state, step.another_way->request.beside, rest_after_admitted(state, &step));
  return step.another_way->request.tries < kReplansMax && !is_as_tried;
}

bool goes_around_idle_arm(Transitions& state) {
  for (const Step& step : state->jobs.past_queue()) {
    const std::vector<Wait>* waits = known_waits(state, step);
    if (waits == nullptr || step.is_replanned_now()) continue;
    const bool for_idle_arm =
        std::ranges::any_of(*waits, [&](const Wait& wait) { return is_idle_arm(state, wait); });
    if (!for_idle_arm || !may_go_around(state, step)) continue;
    ask_for_another_way(state, step, AnotherWay::Cause::blocked);
    return true;
  }
  return false;
}

bool goes_on_after_timeout(Transitions& state, const Step& step) {
  if (step.is_replanned_now()) return true;
  if (step.job->terms.on_timeout != OnTimeout::replan || step.is_unplanned() ||
      why_not_replanned(step))
    return false;
  if (step.another_way && step.another_way->request.tries >= kReplansMax) return false;
  ask_for_another_way(state, step, AnotherWay::Cause::timeout);
  return true;
}

void expire(Transitions& state, const Step& step, const std::string& why) {
  const char* where = step.has_started() ? " on its path" : " in the backlog";
  give_up_with_approaches(
      state, step,
      {AfterStop::Then::fail, Reason::backlog_timeout,
       "waited " + seconds_text(*step.job->terms.backlog_timeout) + where + why});
}

}  // namespace armloom
