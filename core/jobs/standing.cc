#include "core/jobs/standing.h"

#include <algorithm>

#include "core/jobs/waits.h"
#include "core/model/promises.h"

namespace armloom {
namespace {

constexpr double kHardlySlow = 1.1;

Promises promises_for(const Cell& cell, const Step& step) {
  return promises_of(cell, step.trajectory->arms());
}

}  // namespace

std::optional<Wait> speed_wait(const State& state, const Step& step) {
  const auto wait = [](std::optional<ArmId> arm, const std::string& whose) {
    return Wait{.kind = Wait::Kind::speed,
                .arm = arm,
                .detail = "the speed override of " + whose + " is 0; raise it to continue"};
  };
  if (state.speed.cell() == 0.0) return wait(std::nullopt, "the cell");
  for (ArmId arm : step.trajectory->arms()) {
    if (state.speed.arm(arm) == 0.0) return wait(arm, "arm " + state.cell->arm(arm).name);
    if (state.speed.brake(arm) > 0.0) continue;
    return Wait{.kind = Wait::Kind::holding,
                .arm = arm,
                .detail = "arm " + state.cell->arm(arm).name +
                          " holds more than its payload permits, so it does not move; let the "
                          "object go with POST /scene/objects/NAME/detach"};
  }
  return std::nullopt;
}

std::optional<Wait> operator_wait(const State& state, const Step& step) {
  if (auto stop = state.arms.stop_of(step)) return stop;
  const auto& arms = step.trajectory->arms();
  const auto* hold = hold_broken_by(arms, state.around.shared_holds);
  if (hold != nullptr && !step.job->awaits_actions) {  // which may let the object go
    const auto is_other = [&](ArmId arm) { return std::ranges::count(arms, arm) == 0; };
    return Wait{.kind = Wait::Kind::holding,
                .arm = *std::ranges::find_if(hold->arms, is_other),
                .detail = text_of(*hold, *state.cell)};
  }
  for (const ArmId arm : arms) {
    const auto other = state.arms.unlocated_beside(arm);
    if (!other) continue;
    const auto& stop = state.arms.stop_of(*other);
    return Wait{.kind = Wait::Kind::stop,
                .arm = other,
                .detail = "the position of " + state.cell->arm(*other).name + " is not known" +
                          (stop ? ": " + stop->cause : "")};
  }
  return speed_wait(state, step);
}

std::optional<Wait> signal_wait(const State& state, const Step& step) {
  const auto& wanted = step.job->terms.start_when;
  if (!wanted || step.times.started_at) return std::nullopt;
  const auto known = state.around.signals.find(wanted->signal);
  const bool is_known = known != state.around.signals.end() && known->second.value;
  if (is_known && known->second.value == wanted->value) return std::nullopt;
  const std::string now = is_known ? text_of(*known->second.value)
                          : known != state.around.signals.end()
                              ? "not known: " + known->second.detail
                              : "not known";
  return Wait{.kind = Wait::Kind::io,
              .detail = wanted->signal + " is " + now + "; the job starts when it is " +
                        text_of(wanted->value),
              .signal = wanted->signal};
}

std::optional<Wait> held_where_it_stands(const State& state, const Step& step) {
  const auto* moving = step.in<Moving>();
  const bool may_stand = step.in<Admitted>() != nullptr || (moving != nullptr && moving->pause);
  if (!may_stand || state.graph.limit(step.id) > step.progress + kAtLimit) return std::nullopt;
  const auto held = state.graph.held_back(step.id);
  return held ? std::optional(wait_for(*held)) : std::nullopt;
}

bool holds_one_ahead(const State& state, const Step& step) {
  const auto& arms = step.trajectory->arms();
  return std::ranges::any_of(arms, [&](ArmId arm) {
    const auto& queue = state.jobs.queues()[arm];
    const auto goes_ahead = [&](StepId id) { return id != step.id && state.graph.holds(id); };
    const auto end = std::ranges::find_if_not(queue, goes_ahead);
    return std::any_of(queue.begin(), end,
                       [&](StepId id) { return state.graph.is_held_by(id, arms); });
  });
}

std::optional<JobId> may_go_first(const State& state, const Step& step) {
  if (step.goal || step.in<Queued>() == nullptr) return std::nullopt;
  if (state.jobs.active().undecided().empty()) return std::nullopt;
  const auto& arms = step.trajectory->arms();
  for (const Step& open : state.jobs.of(state.jobs.active().undecided())) {
    if (!open.has_open_arm() || open.job->turn > step.job->turn) continue;
    if (step.approaches.ahead_of.contains(open.id.job)) continue;
    const bool shares = std::ranges::any_of(open.goal->ways, [&](const GoalWay& way) {
      return std::ranges::find(arms, way.goal.arm) != arms.end();
    });
    if (shares && state.arms.begins_elsewhere(*state.cell, *step.trajectory)) {
      return open.id.job;
    }
  }
  return std::nullopt;
}

const std::vector<Wait>* known_waits(const State& state, const Step& step) {
  if (step.pausing()) return &step.waits_on;
  const bool is_put_off = step.is_waiting() && state.is_judged(step);
  return is_put_off ? &step.judgement().found : nullptr;
}

bool is_idle_arm(const State& state, const Wait& wait) {
  return wait.kind == Wait::Kind::arm && wait.arm && state.jobs.queues()[*wait.arm].empty();
}

std::optional<TimePoint> stands_since(const Step& step) {
  if (const auto* moving = step.in<Moving>()) {
    return moving->pause ? std::nullopt : std::optional(moving->moved_at);
  }
  const bool stopped = step.in<Braking>() != nullptr || step.in<Held>() != nullptr;
  return stopped ? std::optional(step.times.measured_at) : std::nullopt;
}

bool is_standing(const Cell& cell, const Step& step, TimePoint now) {
  const auto* moving = step.in<Moving>();
  return moving != nullptr && now - moving->moved_at >= promises_for(cell, step).stands_from();
}

Duration stood_for(const Cell& cell, const Step& step, TimePoint now) {
  const auto since = stands_since(step);
  if (!since) return Duration{};
  const Duration stood = now - *since;
  return stood < promises_for(cell, step).stands_from() ? Duration{} : stood;
}

double pace_of(const Cell& cell, const Step& step, double planned, TimePoint now) {
  const auto* moving = step.in<Moving>();
  if (moving == nullptr || moving->pause || is_standing(cell, step, now)) return planned;
  const Duration way = step.progress - moving->goes_from;
  if (way < promises_for(cell, step).pace_from()) return planned;
  const double pace = to_seconds(moving->moved_at - moving->goes_since) / to_seconds(way);
  return pace < kHardlySlow * planned ? planned : pace;
}

}  // namespace armloom
