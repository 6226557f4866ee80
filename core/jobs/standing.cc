#include "core/jobs/standing.h"

#include <algorithm>

#include "core/jobs/waits.h"

namespace armloom {

std::optional<Wait> speed_wait(const State& state, const Job& job) {
  const auto wait = [](std::optional<ArmId> arm, const std::string& whose) {
    return Wait{.kind = Wait::Kind::speed,
                .arm = arm,
                .detail = "the speed override of " + whose + " is 0; raise it to continue"};
  };
  if (state.speed.cell() == 0.0) return wait(std::nullopt, "the cell");
  for (ArmId arm : job.trajectory->arms()) {
    if (state.speed.arm(arm) == 0.0) return wait(arm, "arm " + state.cell->arm(arm).name);
  }
  return std::nullopt;
}

std::optional<Wait> operator_wait(const State& state, const Job& job) {
  if (auto stop = state.arms.stop_of(job)) return stop;
  for (const ArmId arm : job.trajectory->arms()) {
    const auto other = state.arms.unlocated_beside(arm);
    if (!other) continue;
    const auto& stop = state.arms.stop_of(*other);
    return Wait{.kind = Wait::Kind::stop,
                .arm = other,
                .detail = "the position of " + state.cell->arm(*other).name + " is not known" +
                          (stop ? ": " + stop->cause : "")};
  }
  return speed_wait(state, job);
}

std::optional<Wait> held_where_it_stands(const State& state, const Record& record) {
  const Job& job = record.job;
  const auto* moving = job.in<Moving>();
  const bool may_stand = job.in<Admitted>() != nullptr || (moving != nullptr && moving->pause);
  if (!may_stand || state.graph.limit(job.step()) > job.progress + kAtLimit) return std::nullopt;
  const auto held = state.graph.held_back(job.step());
  return held ? std::optional(wait_for(*held)) : std::nullopt;
}

bool holds_one_ahead(const State& state, const Record& record) {
  const auto& arms = record.job.trajectory->arms();
  return std::ranges::any_of(arms, [&](ArmId arm) {
    const auto& queue = state.jobs.queues()[arm];
    const auto goes_ahead = [&](StepId step) {
      return step != record.job.step() && state.graph.holds(step);
    };
    const auto end = std::ranges::find_if_not(queue, goes_ahead);
    return std::any_of(queue.begin(), end,
                       [&](StepId step) { return state.graph.is_held_by(step, arms); });
  });
}

std::optional<JobId> may_go_first(const State& state, const Record& record) {
  const Job& job = record.job;
  if (job.goal || job.in<Queued>() == nullptr) return std::nullopt;
  if (state.jobs.undecided().empty()) return std::nullopt;
  const auto& arms = job.trajectory->arms();
  for (JobId id : state.jobs.undecided()) {
    const Record& open = state.jobs.at(id);
    if (!open.job.has_open_arm() || open.turn > record.turn) continue;
    if (record.approaches.ahead_of.contains(id)) continue;
    const bool shares = std::ranges::any_of(open.job.goal->ways, [&](const GoalWay& way) {
      return std::ranges::find(arms, way.goal.arm) != arms.end();
    });
    if (shares && state.arms.begins_elsewhere(*state.cell, *job.trajectory)) return id;
  }
  return std::nullopt;
}

const std::vector<Wait>* known_waits(const State& state, const Job& job) {
  if (job.pausing()) return &job.waits_on;
  const bool is_put_off = job.is_waiting() && state.is_judged(job);
  return is_put_off ? &job.judgement().found : nullptr;
}

bool is_idle_arm(const State& state, const Wait& wait) {
  return wait.kind == Wait::Kind::arm && wait.arm && state.jobs.queues()[*wait.arm].empty();
}

}  // namespace armloom
