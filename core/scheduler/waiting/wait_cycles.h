#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/jobs/state.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// What becomes of a ring is a matter of a step of its own, so long after it was told.
inline constexpr Duration kAfterRingWasTold(1);

// Jobs that wait for each other in a ring can never move: each is told its ring in the step that
// finds it. Then, in a later step, the first of these that is possible:
//   - a job that is brought to its start goes before one with an open arm that waits for it
//   - a job goes by another arm or another way, or an arm goes aside and comes back
//   - the job that was submitted last fails, of those whose arms have lost none since they moved
//   - nothing, if a job of the ring expires in time
//   - the job that was submitted last fails
// So a blockage costs each arm one job, and those behind it are kept (ways/approach.h).
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
    Version epoch;               // State::scene_epoch when it was found
    std::vector<JobId> in_turn;  // wait for the next one, though that was not found in their way
    bool way_out = false;        // an arm of it may go aside, or one of it expires
  };
  // An arm whose job has failed for a ring, until it has moved or the scene is another one.
  struct Lost {
    TrajectoryPtr came_by;
    Version epoch;
  };
  [[nodiscard]] bool stands_still(const State& state, const Named& named) const;
  [[nodiscard]] bool has_lost_one(const State& state, const Record& record) const;
  [[nodiscard]] std::optional<JobId> gives_way(const State& state, const WaitCycle& ring) const;
  bool resolve(State& state, const WaitCycle& ring);

  std::vector<Named> named_;  // told in an earlier step
  std::map<ArmId, Lost> lost_;
};

}  // namespace armloom
