#pragma once

#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/jobs/state.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// What becomes of a ring is a matter of a step of its own, so long after it was told.
inline constexpr Duration kAfterRingWasTold(1);

// Jobs that wait for each other in a ring can never move: each is told its ring in the step that
// finds it. Then an arm of the ring goes aside and comes back when the other has passed, if the
// cell says so and there is such a way; else the job that was submitted last fails.
class WaitCycles {
 public:
  // Every job of a ring is told of it now; what becomes of the ring is decided in a later step, so
  // that it is seen by clients whatever that is.
  void name(State& state);
  // Of those that were named before: what has become of them, or is to.
  void settle(State& state);
  [[nodiscard]] bool is_one_to_settle() const;

  // The first way in which an arm of one of them could go aside.
  [[nodiscard]] std::optional<YieldTrial> next_yield(const State& state) const;
  // An arm goes aside before this job of its own.
  void has_opened(State& state, JobId before);

 private:
  struct Named {
    WaitCycle ring;
    Version epoch;         // State::recheck_epoch when it was found
    bool way_out = false;  // an arm of it may go aside
  };
  std::vector<Named> named_;  // told in an earlier step
};

}  // namespace armloom
