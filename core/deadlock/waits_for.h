#pragma once

#include <compare>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "core/base/ids.h"

namespace armloom {

// A node of the waits-for graph: a waiting job, or an arm at rest, which moves only with its next
// job. Jobs sort before arms, and smaller ids first.
using Waiter = std::variant<JobId, ArmId>;

// `waits` cannot move before `first` does.
struct WaitsForEdge {
  Waiter waits;
  Waiter first;
  auto operator<=>(const WaitsForEdge&) const = default;
};

// The waits-for graph; immutable. A node can move only after all nodes that it waits for. An arm at
// rest without an outgoing edge has no job that would move it.
class WaitsFor {
 public:
  // Takes edges in any order; duplicates are ignored. O(n log n).
  explicit WaitsFor(std::vector<WaitsForEdge> edges);

  // Returns all nodes that occur in an edge, ascending.
  [[nodiscard]] const std::vector<Waiter>& nodes() const { return nodes_; }
  // Returns the indices of the nodes that `node` waits for, ascending.
  [[nodiscard]] std::span<const std::size_t> first_of(std::size_t node) const {
    return {targets_.data() + begins_[node], begins_[node + 1] - begins_[node]};
  }
  // Returns nodes().size() if the waiter is not in the graph.
  [[nodiscard]] std::size_t index_of(const Waiter& waiter) const;

  // Returns all nodes that `waiter` waits for, directly or through others; ascending, without
  // `waiter`.
  [[nodiscard]] std::vector<Waiter> all_before(const Waiter& waiter) const;

 private:
  std::vector<Waiter> nodes_;
  std::vector<std::size_t> begins_;  // per node: first index into targets_; plus the end
  std::vector<std::size_t> targets_;
};

// A deadlock cycle of at least two different jobs, none of which can move. Each job waits for the
// next one, or for an arm at rest that only the next one will move. The last job waits for the
// first in the same way.
using WaitCycle = std::vector<JobId>;

// Returns one elementary cycle for each strongly connected component (Tarjan 1972). It is the
// shortest cycle through the component's smallest job and begins with that job; ties are broken by
// ids. The cycles are disjoint, and ascending by their first job. Cycles of a single job are
// ignored because an arm does not block its own job. O(n log n).
[[nodiscard]] std::vector<WaitCycle> find_wait_cycles(const WaitsFor& graph);

// Rotates the cycle so that `first` comes first. Throws std::invalid_argument if `first` is not in
// the cycle.
[[nodiscard]] WaitCycle beginning_with(JobId first, WaitCycle ring);

}  // namespace armloom
