#pragma once

#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/coordination/verdict.h"

namespace armloom {

// A job that waits, in the order of its arms' queues.
struct WaitingWork {
  JobId job;
  std::vector<ArmId> arms;
};

// The banker's question (Dijkstra 1965), with places in the way instead of money: when everything
// that is admitted has come to its goal, and `done` besides, can all the others that wait still be
// done, at least one after the other? `rests` says whose way an arm at rest is in. The jobs in an
// order that does it; nothing: there is none, or none was found among kStatesMax states. Pure.
inline constexpr std::size_t kStatesMax = 2000;
[[nodiscard]] std::optional<std::vector<JobId>> order_of_work(
    const std::vector<WaitingWork>& waiting, const std::vector<RestInTheWay>& rests,
    const std::vector<JobId>& done);

}  // namespace armloom
