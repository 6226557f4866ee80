#pragma once

#include <optional>

#include "core/jobs/state.h"

namespace armloom {

// Jobs that say where an arm is to go (Submit::goals). Each waits at a gate of its own until its
// trajectory is planned from where the arm will be at the end of what is before it, beside all else
// where the jobs before it leave that; then it is a job like any other. Until then its trajectory
// is an estimate. One that leaves the arm open has its way planned for each; which of these it goes
// is chosen at its turn (waiting/choosing.h): the one by which it arrives first. Until then the
// jobs behind it are planned as if it went by another arm.

// One whose arm stands too close to an object has no plan until that has gone, and waits for it at
// its turn as a trajectory does: in the backlog, until its timeout.

// Asks for what has no plan (PlanMotion), or one that no longer fits: the arm will be elsewhere, or
// the scene is another one. A job is given kPlansMax tries in a row, then it fails. Whether one
// did: then others may begin elsewhere.
[[nodiscard]] bool plan_goals(State& state);
inline constexpr int kPlansMax = 5;
// Of each arm's jobs the first ones are planned.
inline constexpr std::size_t kPlannedAhead = 16;

// It is to be planned anew, though what was planned would do.
void forget_plan(State& state, Record& record);

// An answer. One that no longer fits is left to plan_goals().
void take_plan(State& state, const PlanMade& answer);

}  // namespace armloom
