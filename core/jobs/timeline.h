#pragma once

#include <optional>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// A leg stands at its start, or on its way.
struct PredictedPause {
  TimePoint from;
  std::optional<TimePoint> to;   // nothing: for ever as things are; then it is the last one
  Duration at;                   // trajectory time at which it stands
  std::optional<Wait> waits_on;  // nothing: it stands for a reason of its arms' own
};

// A motion that is admitted. It follows the one before it on its arms; that wait is no pause.
struct PredictedLeg {
  JobId job;
  std::optional<TimePoint> starts;  // leaves its start, or has left it; nothing: never
  std::optional<TimePoint> ends;    // nothing: it does not come to its end as things are
  std::vector<PredictedPause> pauses;
};

struct PredictedTimeline {
  TimePoint now;
  std::vector<PredictedLeg> legs;  // those of one arm in the order in which they go
};

// What follows from the precedence graph, whichever policy chose the orders, if everything goes as
// fast as its trajectory says: when each leg moves and whom it waits for. A pause on the way costs
// kPauseLoss beside the wait. What stands though nothing of ours holds it (late, stalled) is
// expected to do so for as long again as it has. An arm that is stopped, or rests in the way, stays
// there: nobody knows when somebody resumes it. Pure. Precondition: `now` is not before state.now.
[[nodiscard]] PredictedTimeline predicted_timeline(const State& state, TimePoint now);

}  // namespace armloom
