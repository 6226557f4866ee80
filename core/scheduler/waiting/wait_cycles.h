#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/jobs/state.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Delay between the publication of a deadlock cycle and its resolution, which is a separate step.
inline constexpr Duration kAfterRingWasTold(1);

// Publishes and resolves deadlock cycles. Each job in a cycle reports it in the step that finds it.
// In a later step, the first possible remedy is taken:
// - a job that is moved to its start precedes a job with an undecided arm that it waits for
// - a job takes another arm or another path, or an arm retreats and returns
// - the job that was submitted last fails, among jobs whose arms have lost none since they moved
// - none, if a job of the cycle expires in time
// - the job that was submitted last fails
// So a deadlock costs each arm at most one job, and the jobs behind it are kept (ways/approach.h).
class WaitCycles {
 public:
  // Publishes new cycles in their jobs. They are resolved in a later step so that clients see them.
  void name(State& state);
  // Resolves the cycles published in earlier steps.
  void settle(State& state);
  [[nodiscard]] bool is_one_to_settle() const;

  // Returns the first possible retreat of an arm in one of the cycles.
  [[nodiscard]] std::optional<YieldTrial> next_yield(const State& state) const;
  // An arm retreats before this job of its queue: drops the cycles that contain the job.
  void has_opened(State& state, JobId before);

 private:
  struct Named {
    WaitCycle ring;
    Version epoch;               // State::scene_epoch when found
    std::vector<JobId> in_turn;  // wait for the next job, but not because of a conflict
    bool way_out = false;        // a retreat or replan is being tried, or a job expires
  };
  // An arm whose job failed for a cycle, until the arm has moved or the scene has changed.
  struct Lost {
    TrajectoryPtr came_by;
    Version epoch;
  };
  [[nodiscard]] bool stands_still(const State& state, const Named& named) const;
  [[nodiscard]] bool has_lost_one(const State& state, const Record& record) const;
  [[nodiscard]] std::optional<JobId> gives_way(const State& state, const WaitCycle& ring) const;
  bool resolve(State& state, const WaitCycle& ring);

  std::vector<Named> named_;  // published in an earlier step
  std::map<ArmId, Lost> lost_;
};

}  // namespace armloom
