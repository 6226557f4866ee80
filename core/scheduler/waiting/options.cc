#include "core/scheduler/waiting/options.h"

#include <algorithm>
#include <utility>

#include "core/scheduler/policy.h"

namespace armloom {
namespace {

ArmId arm_of(const Trajectory& trajectory) { return trajectory.arms().front(); }

// One arm, which it leaves where it was.
bool is_loop(const Record& record) {
  return record.leg.arms.size() == 1 && record.leg.from == record.leg.to;
}

bool may_change_places(const Record& record) {
  return record.job.any_order && record.job.in<Queued>() != nullptr && is_loop(record) &&
         record.job.after.empty() && !record.before && !record.lets_pass;
}

bool is_overtaken_no_more(const State& state, const Record& record) {
  return record.overtaken_at && state.now - *record.overtaken_at >= state.cell->scheduling.aging;
}

std::vector<Option> in_any_order(const State& state, const Record& turn) {
  std::vector<Option> options{{turn.job.id}};
  if (!may_change_places(turn) || is_overtaken_no_more(state, turn)) return options;
  for (JobId id : state.jobs.queue(turn.leg.arms.front())) {
    if (options.size() >= kOptionsMax) break;
    const Record& other = state.jobs.at(id);
    const bool fits = id != turn.job.id && may_change_places(other) &&
                      other.job.priority == turn.job.priority && other.leg.from == turn.leg.from;
    if (fits) options.push_back({id});
  }
  return options;
}

// Where the arm stands when all that is admitted on it has ended.
PlacePtr end_of_admitted(const State& state, ArmId arm) {
  PlacePtr place = state.arms.place(arm);
  for (JobId id : state.jobs.queue(arm)) {
    const Record& record = state.jobs.at(id);
    if (record.job.in<Queued>() != nullptr) break;
    for (std::size_t i = 0; i < record.leg.arms.size(); ++i) {
      if (record.leg.arms[i] == arm) place = record.leg.to[i];
    }
  }
  return place;
}

bool begins_at(const State& state, const Trajectory& trajectory, const Place& place) {
  const Arm& arm = state.cell->arm(place.arm);
  const double tolerance = state.cell->execution.start_tolerance_rad;
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const auto j = std::ranges::find(trajectory.joints(), arm.joints[i]);
    if (j == trajectory.joints().end()) continue;
    const auto index = j - trajectory.joints().begin();
    const double off = trajectory.start()[index] - place.q[static_cast<Eigen::Index>(i)];
    if (std::abs(off) > tolerance) return false;
  }
  return true;
}

// Whatever came before it on that arm is admitted, no more than the policy looks ahead, and leads
// to where it begins.
bool has_turn(const State& state, const Record& record, const Trajectory& trajectory) {
  const ArmId arm = arm_of(trajectory);
  if (state.arms.is_stopped(arm)) return false;
  std::size_t admitted = 0;
  for (JobId id : state.jobs.queue(arm)) {
    const Record& other = state.jobs.at(id);
    if (id == record.job.id) break;
    if (other.job.in<Queued>() == nullptr) {
      if (!other.job.is_admitted()) return false;  // it may rest anywhere
      if (++admitted >= state.policy->horizon()) return false;
    } else if (other.turn < record.turn) {
      return false;
    }
  }
  return begins_at(state, trajectory, *end_of_admitted(state, arm));
}

std::vector<Option> on_several_arms(const State& state, const Record& record) {
  const auto& alternatives = record.job.alternatives;
  std::vector<Option> options;
  for (std::size_t k = 0; k < alternatives.size(); ++k) {
    const Option option{record.job.id, k, has_turn(state, record, *alternatives[k])};
    const bool is_now = alternatives[k] == record.job.trajectory;
    options.insert(is_now ? options.begin() : options.end(), option);
  }
  std::erase_if(options, [&](const Option& option) {
    return !option.goes_now && state.arms.is_stopped(arm_of(*alternatives[option.alternative]));
  });
  return options;
}

void take_arm(State& state, Record& record, const TrajectoryPtr& trajectory) {
  if (record.job.trajectory == trajectory) return;
  WaitingLeg leg = state.arms.leg_of(*state.cell, record.job.id, *trajectory);
  state.jobs.take(record, trajectory, std::move(leg));
  state.lanes.renew_later();
}

}  // namespace

std::vector<Option> options_of(State& state, JobId turn) {
  const Record& record = state.jobs.at(turn);
  if (record.job.in<Queued>() == nullptr) return {{turn}};
  return record.job.alternatives.empty() ? in_any_order(state, record)
                                         : on_several_arms(state, record);
}

bool has_turn_on_some_arm(const State& state, const Record& record) {
  return std::ranges::any_of(record.job.alternatives, [&](const TrajectoryPtr& trajectory) {
    return has_turn(state, record, *trajectory);
  });
}

void give_turn(State& state, JobId holder, const Option& option) {
  Record& taker = state.jobs.at(option.job);
  if (!taker.job.alternatives.empty()) {
    return take_arm(state, taker, taker.job.alternatives[option.alternative]);
  }
  if (holder == option.job) return;
  state.jobs.exchange(state.jobs.at(holder), taker);
  state.lanes.renew_later();
  auto& round = state.round.jobs;
  if (round.erase(holder) > 0) round.insert(option.job);
}

bool begins_on_other_arm(State& state, Record& record) {
  for (const TrajectoryPtr& other : record.job.alternatives) {
    if (record.job.in<Queued>() == nullptr) return false;
    if (!begins_at(state, *other, *end_of_admitted(state, arm_of(*other)))) continue;
    take_arm(state, record, other);
    return true;
  }
  return false;
}

}  // namespace armloom
