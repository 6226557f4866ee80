#pragma once

#include "core/jobs/state.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// A goal whose way is the shortest that there is, but has to wait for others: is there another one,
// around the places that they hold, by which the arm arrives sooner? At the job's turn some are
// asked for, each within kDetourBudget; the job has each for a while and is judged by it as if
// there were no other. It goes by the one with which it arrives first, as the policy predicts it,
// or by the first that hardly waits. A place that is held is gone around once.

// Before this wait is worth the question.
inline constexpr Duration kWaitWorthADetour = std::chrono::milliseconds(500);
inline constexpr std::uint64_t kDetourBudget = 40'000;  // evaluations
inline constexpr int kDetoursMax = 4;                   // of one job

// The policy's answer about the job, and where it meets others. Whether it is to be judged once
// more before it goes: by another way, which is asked for (PlanMotion), or by its own again.
[[nodiscard]] bool weighs_detour(State& state, Record& record,
                                 const std::vector<PairRegions>& regions,
                                 const PassingOrders& orders);
// It would have to be put off: it has its own way again, and is judged by that. One around what
// others hold is for going at once; later it may be in the way of others, or they in its.
[[nodiscard]] bool gives_detour_up(State& state, Record& record);
// The answer to a PlanMotion, if it is one of these.
void take_detour(State& state, const PlanMade& answer);

}  // namespace armloom
