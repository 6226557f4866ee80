#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/plan_question.h"
#include "core/coordination/verdict.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// The requests for a path for one purpose. At most one is open (PlanRequests).
struct PathRequest {
  // Positions of all arms in the last question. Without entries, no answer is up to date.
  Configuration beside = {};
  Version asked_at = 0;  // version of the last question
  int tries = 0;         // questions since the owner last reset this
};

// A goal for one arm, and the plan for it (goals.h).
struct GoalWay {
  MotionGoal goal;
  PathRequest request = {};                 // its tries: since the last plan that was up to date
  bool is_planned = false;                  // the job's trajectory is the plan, not an estimate
  std::optional<std::string> refusal = {};  // the planner's reason, if there is no plan
  std::optional<Proximity> stands_in = {};  // ... because the arm is too close to this object
  bool goes_through = false;                // the plan crosses positions of other arms (PlanMade)
};
// Detours of a goal's path around positions that other arms occupy (detour.h).
struct Detour {
  PathRequest request = {};
  bool is_weighed = false;       // the job temporarily has a candidate path, and is checked with it
  TrajectoryPtr best = nullptr;  // the best path so far (a candidate, or the job's own), ...
  TimePoint arrives{};           // ... and its predicted arrival
  bool is_taken = false;         // the selected path is a detour
  Duration saves{};              // time saved; zero if the shortest path was not possible
  TimePoint soon_enough{};       // a candidate that arrives by then is taken at once
};
struct JobGoal {
  // One for each of Job::alternatives until the arm is decided; else one.
  std::vector<GoalWay> ways;
  std::size_t taken = 0;    // index of the entry that belongs to Job::trajectory
  bool is_planned = false;  // all remaining entries are answered, and the one at `taken` has a plan
  std::optional<Detour> detour = {};

  [[nodiscard]] const GoalWay& way() const { return ways[taken]; }
};

// Replanning of a job (replanning.h).
struct AnotherWay {
  enum class Cause {
    client,   // requested by a client
    timeout,  // after the backlog timeout
    blocked,  // the job is blocked by an arm that no job moves, or is in a deadlock cycle
  };
  Cause cause = Cause::client;
  bool is_open = false;                     // requested and not answered
  PathRequest request = {};                 // its tries: since the last request by a client
  std::uint64_t done = 0;                   // number of successful replans
  std::optional<std::string> refusal = {};  // why the last one failed
};
[[nodiscard]] constexpr const char* to_string(AnotherWay::Cause cause) {
  switch (cause) {
    case AnotherWay::Cause::client:
      return "client";
    case AnotherWay::Cause::timeout:
      return "timeout";
    case AnotherWay::Cause::blocked:
      return "blocked";
  }
  return nullptr;
}

}  // namespace armloom
