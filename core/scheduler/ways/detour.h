#pragma once

#include "core/jobs/state.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// Detours for a goal whose shortest path has to wait for other motions: is there a path around the
// positions that they occupy by which the arm arrives sooner? At the job's turn several are
// planned, each within kDetourBudget. The job gets each temporarily and is checked with it as if
// there were no other. It takes the path with the earliest predicted arrival, or the first one that
// hardly waits. The same occupied positions are not avoided twice.

// Shorter waits are not worth a query.
inline constexpr Duration kWaitWorthADetour = std::chrono::milliseconds(500);
inline constexpr std::uint64_t kDetourBudget = 40'000;  // evaluations
inline constexpr int kDetoursMax = 4;                   // for one plan of a job

// Takes the policy's answer about the job, and its regions. Returns true if the job must be checked
// once more: with another path, which is requested (PlanMotion), or with its own again.
[[nodiscard]] bool weighs_detour(State& state, Record& record,
                                 const std::vector<PairRegions>& regions,
                                 const PassingOrders& orders);
// The job would be deferred: gives it its own path again. Returns true if it must be checked with
// that. A detour is for an immediate start; later it may block others, or they may block it.
[[nodiscard]] bool gives_detour_up(State& state, Record& record);
// Takes the answer to a PlanMotion if it is for a detour.
void take_detour(State& state, const PlanMade& answer);

}  // namespace armloom
