#include "core/scheduler/groups.h"

#include <algorithm>
#include <set>

#include "core/jobs/standing.h"
#include "core/policies/policy.h"
#include "core/scheduler/waiting/gates.h"

namespace armloom {
namespace {

bool contains(const std::vector<StepId>& group, StepId step) {
  return std::ranges::find(group, step) != group.end();
}

// Returns the jobs of each arm's first steps that are neither admitted nor in the group.
std::set<JobId> first_of_arms(const State& state, const std::vector<StepId>& group) {
  std::set<JobId> jobs;
  for (const auto& queue : state.jobs.queues()) {
    std::size_t left = kTogetherMax;
    for (auto step = queue.begin(); step != queue.end() && left > 0; ++step) {
      if (state.graph.holds(*step) || contains(group, *step)) continue;
      jobs.insert(step->job);
      --left;
    }
  }
  return jobs;
}

// Returns true if the job could be admitted together with the jobs before it on its arms.
bool may_follow(const State& state, const Step& step) {
  const auto blocks_group = [](const Gate& gate) {
    return blocks_start(gate) && gate.ended_by != EndedBy::queue;
  };
  return step.is_waiting() && !step.is_unplanned() && !any_closed(state, step, blocks_group) &&
         state.lanes.follows_on(step.id) && !holds_one_ahead(state, step);
}

}  // namespace

std::vector<StepId> with_all_that_wait(const State& state, const std::vector<StepId>& group) {
  std::vector<StepId> all = group;
  std::vector<std::size_t> left(state.cell->arms.size(), kTogetherMax);
  for (JobId id : in_turn(state.jobs, first_of_arms(state, group))) {
    const Step& step = state.jobs.at(id);
    const auto& arms = step.trajectory->arms();
    const bool room = std::ranges::all_of(arms, [&](ArmId arm) { return left[arm.index()] > 0; });
    bool goes = room && may_follow(state, step);
    if (goes) {
      all.push_back(step.id);
      goes = follow_each_other(state, all);
      if (!goes) all.pop_back();
    }
    for (ArmId arm : arms) left[arm.index()] = goes ? left[arm.index()] - 1 : 0;
  }
  return all;
}

bool follow_each_other(const State& state, const std::vector<StepId>& steps) {
  std::vector<PlacePtr> stands = state.arms.places();
  const auto comes = [&](const WaitingLeg& leg) {
    for (std::size_t i = 0; i < leg.arms.size(); ++i) stands[leg.arms[i].index()] = leg.to[i];
  };
  for (const CoordinatedMotion& motion : state.graph.motions()) {
    if (!contains(steps, motion.step)) comes(state.jobs.at(motion.step).leg);
  }
  // A place is known up to rounding. The start itself is compared exactly before it is dispatched.
  const double tolerance = state.cell->execution.start_tolerance_rad + Places::kRounding;
  const auto is_near = [&](const PlacePtr& begins, const PlacePtr& at) {
    return begins == at || (begins->q - at->q).cwiseAbs().maxCoeff() <= tolerance;
  };
  return std::ranges::all_of(steps, [&](StepId id) {
    const Step& step = state.jobs.at(id);
    const WaitingLeg& leg = step.leg;
    bool follows = true;
    for (std::size_t i = 0; i < leg.arms.size() && !step.has_started(); ++i) {
      follows = follows && is_near(leg.from[i], stands[leg.arms[i].index()]);
    }
    comes(leg);
    return follows;
  });
}

std::vector<StepId> with_next_jobs(const State& state, std::vector<StepId> group,
                                   const std::vector<ArmId>& in_the_way) {
  if (!state.policy->lookahead.admits_groups) return group;
  const auto goes = [&](StepId step) { return state.graph.holds(step) || contains(group, step); };
  const auto next_of = [&](ArmId arm) {
    const auto& queue = state.jobs.queues()[arm];
    const auto next = std::ranges::find_if_not(queue, goes);
    return next == queue.end() ? std::nullopt : std::optional(*next);
  };
  for (ArmId arm : in_the_way) {
    const auto next = next_of(arm);
    if (!next || group.size() >= 2 * state.cell->arms.size()) continue;
    const Step& step = state.jobs.at(*next);
    const bool is_next = std::ranges::all_of(step.trajectory->arms(),
                                             [&](ArmId own) { return next_of(own) == next; });
    if (is_next && may_follow(state, step)) group.push_back(*next);
  }
  return group;
}

}  // namespace armloom
