#pragma once

#include <optional>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// A pause: a motion rests at its start or on its path.
struct PredictedPause {
  TimePoint from;
  std::optional<TimePoint> to;   // nullopt: no end predicted; only for the last pause
  Duration at;                   // trajectory time of the pause
  std::optional<Wait> waits_on;  // nullopt if the arm rests without being held back by orders
};

// A view of an admitted step: when it moves. Time in which it waits for earlier motions of its own
// arms is not a pause.
struct PredictedLeg {
  StepId step;
  std::optional<TimePoint> starts;  // when it leaves, or has left, its start; nullopt: never
  std::optional<TimePoint> ends;    // nullopt: no end predicted
  std::vector<PredictedPause> pauses;
};

struct PredictedTimeline {
  TimePoint now;
  std::vector<PredictedLeg> legs;  // of one arm: in running order
};

// Predicts from the precedence graph when each admitted motion moves and what it waits for.
// Assumptions:
// - Every motion keeps its speed; a pause on the path costs kPauseLoss in addition.
// - An arm that is late or stalled rests for as long again as it has rested.
// - Stopped arms, and arms that rest in another arm's path, stay there.
// Pure. Precondition: `now` >= state.now.
[[nodiscard]] PredictedTimeline predicted_timeline(const State& state, TimePoint now);

}  // namespace armloom
