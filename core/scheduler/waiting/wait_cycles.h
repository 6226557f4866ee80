#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/jobs/transitions.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Delay between the step that publishes a deadlock cycle and the step that resolves it.
inline constexpr Duration kAfterRingWasTold(1);

// Publishes and resolves deadlock cycles. In the step that finds a cycle, each of its jobs reports
// it. In a later step, the first of these remedies that is possible is taken:
// - a job that is moved to its start no longer waits for a job with an undecided arm
// - a job takes another arm or another path, or an arm retreats
// - an arm that has retreated for a job of the cycle returns
// - a job fails: a retreat that no client job needs, else the client job that was submitted last;
//   jobs whose arm has already lost a job and has not moved since are left out
// - if only such jobs are left: nothing is done if a job of the cycle will expire
// - otherwise one of them fails, chosen in the same way
// So a deadlock costs each arm at most one job, and the jobs behind it are kept (ways/approach.h).
class WaitCycles {
 public:
  // Finds new cycles and publishes them in their jobs. They are resolved in a later step, so that
  // clients see them.
  void name(Transitions& state);
  // Resolves the cycles published in earlier steps.
  void settle(Transitions& state);
  [[nodiscard]] bool is_one_to_settle() const;

  // Returns the first possible retreat of an arm in one of the cycles.
  [[nodiscard]] std::optional<YieldTrial> next_yield(const State& state) const;
  // Call when an arm retreats before the job `before` of its queue. The cycles that contain this
  // job are open, and are dropped.
  void has_opened(Transitions& state, JobId before);

 private:
  struct Named {
    WaitCycle ring;
    Version epoch;               // Surroundings::scene_since when found
    std::vector<JobId> in_turn;  // jobs that wait for the next job, but not because of a conflict
    bool way_out = false;        // a retreat or replan is being tried, or a job expires
  };
  // An arm whose job failed because of a deadlock cycle. Kept until the arm has moved or the scene
  // has changed.
  struct Lost {
    TrajectoryPtr came_by;
    Version epoch;
  };
  [[nodiscard]] bool stands_still(const State& state, const Named& named) const;
  [[nodiscard]] bool has_lost_one(const State& state, const Step& step) const;
  [[nodiscard]] std::optional<JobId> gives_way(const State& state, const WaitCycle& ring) const;
  bool resolve(Transitions& state, const WaitCycle& ring);

  std::vector<Named> named_;  // published in an earlier step
  std::map<ArmId, Lost> lost_;
};

}  // namespace armloom
