#pragma once

#include "core/jobs/transitions.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// Detours for a goal whose shortest path has to wait for other motions. A detour leads around the
// positions that these motions occupy, so that the arm may arrive sooner. At the job's turn,
// detours are planned one after the other, each within kDetourBudget. The job gets each detour
// temporarily and is checked with it as if there were no other path. It takes the path with the
// earliest predicted arrival, or the first path that hardly waits. Detours around the same occupied
// positions are not planned twice.

// For shorter waits no detour is planned.
inline constexpr Duration kWaitWorthADetour = std::chrono::milliseconds(500);
inline constexpr std::uint64_t kDetourBudget = 40'000;  // evaluations
inline constexpr int kDetoursMax = 4;                   // for one plan of a job

// Takes the job's conflict regions and the policy's answer, `orders`. Returns true if the job must
// be checked once more: with another path, which was requested (PlanMotion), or with the best path
// so far.
[[nodiscard]] bool weighs_detour(Transitions& state, const Step& step,
                                 const std::vector<PairRegions>& regions,
                                 const PassingOrders& orders);
// Call when the job would be deferred: drops its detour, because a detour is only good for an
// immediate start. Returns true if the job must be checked again with another path, or planned
// again.
[[nodiscard]] bool gives_detour_up(Transitions& state, const Step& step);
// Handles the planner's answer for the job's detour.
void take_detour(Transitions& state, const Step& step, const PlanMade& answer);

}  // namespace armloom
