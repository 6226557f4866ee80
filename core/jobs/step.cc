#include "core/jobs/step.h"

namespace armloom {

void Step::note_start(TimePoint now) {
  if (!times.motion_started_at) times.motion_started_at = now;
  if (!times.started_at) times.started_at = now;
}

JobState Step::state() const {
  if (const auto* queued = in<Queued>()) {
    return queued->in_backlog ? JobState::backlogged : JobState::queued;
  }
  if (const auto* ended = in<Ended>()) return ended->state;
  if (in<Held>() != nullptr) return JobState::paused;
  if (const auto* braking = in<Braking>()) return braking->state;
  const auto* moving = in<Moving>();
  return moving != nullptr && moving->is_under_way ? JobState::running : JobState::scheduled;
}

const Pause* Step::pause() const {
  if (const auto* held = in<Held>()) return &held->pause;
  const auto* admitted = in<Admitted>();
  if (admitted != nullptr && admitted->pause) return &*admitted->pause;
  const auto* moving = in<Moving>();
  return moving != nullptr && moving->pause ? &*moving->pause : nullptr;
}

bool Step::pausing() const { return is_admitted() && pause() != nullptr; }

const GoalWay* Step::stands_in() const {
  if (!is_unplanned()) return nullptr;
  const GoalWay* first = nullptr;
  for (std::size_t k = 0; k < goal->ways.size(); ++k) {
    const GoalWay& way = goal->ways[k];
    if (!has_open_arm() && k != goal->taken) continue;
    if (plans.is_open(ForGoal{k}) || way.is_planned) return nullptr;
    if (way.stands_in && first == nullptr) first = &way;
  }
  return first;
}

const Braking* Step::ends_by_braking() const {
  const auto* braking = in<Braking>();
  return braking != nullptr && braking->after.ends() ? braking : nullptr;
}

}  // namespace armloom
