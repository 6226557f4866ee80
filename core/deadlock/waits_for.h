#pragma once

#include <compare>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "core/base/ids.h"

namespace armloom {

// Who waits: a job that cannot start, or an arm at rest, which moves with its next job only. Jobs
// come before arms, smaller ids first.
using Waiter = std::variant<JobId, ArmId>;

// `waits` cannot move before `first` does.
struct WaitsForEdge {
  Waiter waits;
  Waiter first;
  auto operator<=>(const WaitsForEdge&) const = default;
};

// The waits-for graph: plain data, immutable. An arm at rest without an edge of its own has no job
// that would move it. Every wait counts: who waits for two can move when both have moved.
class WaitsFor {
 public:
  // Edges in any order; repeated ones count once. n log n.
  explicit WaitsFor(std::vector<WaitsForEdge> edges);

  // All that occur in an edge, ascending.
  [[nodiscard]] const std::vector<Waiter>& nodes() const { return nodes_; }
  // What the node with this index waits for: indices of nodes, ascending.
  [[nodiscard]] std::span<const std::size_t> first_of(std::size_t node) const {
    return {targets_.data() + begins_[node], begins_[node + 1] - begins_[node]};
  }
  // nodes().size(): not in the graph.
  [[nodiscard]] std::size_t index_of(const Waiter& waiter) const;

  // Everything that has to move before `waiter` does, in turn; ascending, without `waiter` itself.
  [[nodiscard]] std::vector<Waiter> all_before(const Waiter& waiter) const;

 private:
  std::vector<Waiter> nodes_;
  std::vector<std::size_t> begins_;  // per node: where its targets begin; one more at the end
  std::vector<std::size_t> targets_;
};

// A deadlock: each job waits for the next one, or for an arm at rest that only the next one will
// move; the last waits for the first. None of them can ever move. Each job once, at least two.
using WaitCycle = std::vector<JobId>;

// Every deadlock: one elementary ring for each strongly connected component that has a cycle,
// beginning with its smallest job, and of the shortest through that one the first by ids (Tarjan
// 1972). The rings have no job in common, and ascend by their first job. An arm does not stand in
// its own job's way: a cycle of one job is none. n log n.
[[nodiscard]] std::vector<WaitCycle> find_wait_cycles(const WaitsFor& graph);

// The same ring told by one of its jobs, which comes first. Precondition (throws
// std::invalid_argument): `first` is in it.
[[nodiscard]] WaitCycle beginning_with(JobId first, WaitCycle ring);

}  // namespace armloom
