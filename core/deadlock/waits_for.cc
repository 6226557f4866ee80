#include "core/deadlock/waits_for.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace armloom {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// Tarjan's algorithm with a stack of its own: chains of waiting jobs are long.
class Components {
 public:
  explicit Components(const WaitsFor& graph)
      : graph_(graph), order_(size(), kNone), low_(size()), of_(size(), kNone) {
    for (std::size_t node = 0; node < size(); ++node) {
      if (order_[node] == kNone) explore(node);
    }
  }
  // Per node: the number of its component.
  [[nodiscard]] const std::vector<std::size_t>& of() const { return of_; }
  // Per component: how many nodes it has.
  [[nodiscard]] const std::vector<std::size_t>& sizes() const { return sizes_; }

 private:
  struct Visit {
    std::size_t node;
    std::size_t next = 0;  // of its targets
  };
  [[nodiscard]] std::size_t size() const { return graph_.nodes().size(); }

  void enter(std::size_t node) {
    order_[node] = low_[node] = entered_++;
    open_.push_back(node);
    path_.push_back({node});
  }

  void explore(std::size_t root) {
    enter(root);
    while (!path_.empty()) {
      Visit& visit = path_.back();
      const auto targets = graph_.first_of(visit.node);
      if (visit.next < targets.size()) {
        const std::size_t target = targets[visit.next++];
        if (order_[target] == kNone) {
          enter(target);
        } else if (of_[target] == kNone) {
          low_[visit.node] = std::min(low_[visit.node], order_[target]);
        }
        continue;
      }
      const std::size_t node = visit.node;
      path_.pop_back();
      if (!path_.empty()) low_[path_.back().node] = std::min(low_[path_.back().node], low_[node]);
      if (low_[node] == order_[node]) close(node);
    }
  }

  void close(std::size_t root) {
    const std::size_t component = sizes_.size();
    sizes_.push_back(0);
    std::size_t node;
    do {
      node = open_.back();
      open_.pop_back();
      of_[node] = component;
      ++sizes_.back();
    } while (node != root);
  }

  const WaitsFor& graph_;
  std::vector<std::size_t> order_, low_, of_;
  std::vector<std::size_t> open_;  // entered, and of no component yet
  std::vector<Visit> path_;
  std::vector<std::size_t> sizes_;
  std::size_t entered_ = 0;
};

// Removes waits of jobs for themselves, and for arms that they move.
WaitsFor without_own(const WaitsFor& graph) {
  std::vector<WaitsForEdge> edges;
  for (std::size_t node = 0; node < graph.nodes().size(); ++node) {
    for (std::size_t first : graph.first_of(node)) {
      const bool arm = std::holds_alternative<ArmId>(graph.nodes()[first]);
      const bool own = arm && std::ranges::binary_search(graph.first_of(first), node);
      if (!own && first != node) edges.push_back({graph.nodes()[node], graph.nodes()[first]});
    }
  }
  return WaitsFor(std::move(edges));
}

// Returns the shortest cycle through `start`, breadth first, smaller nodes first; empty if there is
// none.
std::vector<std::size_t> shortest_cycle(const WaitsFor& graph, std::size_t start,
                                        const std::vector<std::size_t>& component) {
  std::vector<std::size_t> queue{start};
  std::vector<std::pair<std::size_t, std::size_t>> came_from;  // node, from; sorted at the end
  std::vector<bool> seen(graph.nodes().size(), false);
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < queue.size() && !last; ++i) {
    for (std::size_t next : graph.first_of(queue[i])) {
      if (next == start) {
        last = queue[i];
        break;
      }
      if (seen[next] || component[next] != component[start]) continue;
      seen[next] = true;
      came_from.emplace_back(next, queue[i]);
      queue.push_back(next);
    }
  }
  std::vector<std::size_t> cycle;
  if (!last) return cycle;
  std::ranges::sort(came_from);
  for (std::size_t node = *last; node != start;) {
    cycle.push_back(node);
    node = std::ranges::lower_bound(came_from, node, {}, &decltype(came_from)::value_type::first)
               ->second;
  }
  cycle.push_back(start);
  std::ranges::reverse(cycle);
  return cycle;
}

}  // namespace

WaitsFor::WaitsFor(std::vector<WaitsForEdge> edges) {
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges);
  edges.erase(repeated.begin(), repeated.end());
  nodes_.reserve(2 * edges.size());
  for (const WaitsForEdge& edge : edges) {
    nodes_.push_back(edge.waits);
    nodes_.push_back(edge.first);
  }
  std::ranges::sort(nodes_);
  const auto again = std::ranges::unique(nodes_);
  nodes_.erase(again.begin(), again.end());
  begins_.assign(nodes_.size() + 1, 0);
  targets_.reserve(edges.size());
  auto edge = edges.begin();
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    for (; edge != edges.end() && edge->waits == nodes_[node]; ++edge) {
      targets_.push_back(index_of(edge->first));
    }
    begins_[node + 1] = targets_.size();
  }
}

std::size_t WaitsFor::index_of(const Waiter& waiter) const {
  const auto it = std::ranges::lower_bound(nodes_, waiter);
  if (it == nodes_.end() || *it != waiter) return nodes_.size();
  return static_cast<std::size_t>(it - nodes_.begin());
}

std::vector<Waiter> WaitsFor::all_before(const Waiter& waiter) const {
  std::vector<Waiter> before;
  const std::size_t start = index_of(waiter);
  if (start == nodes_.size()) return before;
  std::vector<bool> seen(nodes_.size(), false);
  seen[start] = true;
  std::vector<std::size_t> open{start};
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    for (std::size_t first : first_of(node)) {
      if (seen[first]) continue;
      seen[first] = true;
      open.push_back(first);
      before.push_back(nodes_[first]);
    }
  }
  std::ranges::sort(before);
  return before;
}

std::vector<WaitCycle> find_wait_cycles(const WaitsFor& graph) {
  const WaitsFor others = without_own(graph);
  const Components components(others);
  std::vector<bool> done(components.sizes().size(), false);
  std::vector<WaitCycle> rings;
  // Jobs come first: the first node of a component that has a cycle is its smallest job.
  for (std::size_t node = 0; node < others.nodes().size(); ++node) {
    const std::size_t component = components.of()[node];
    if (done[component] || components.sizes()[component] < 2) continue;
    done[component] = true;
    WaitCycle ring;
    for (std::size_t on_it : shortest_cycle(others, node, components.of())) {
      if (const auto* job = std::get_if<JobId>(&others.nodes()[on_it])) ring.push_back(*job);
    }
    if (ring.size() >= 2) rings.push_back(std::move(ring));
  }
  return rings;
}

WaitCycle beginning_with(JobId first, WaitCycle ring) {
  const auto it = std::ranges::find(ring, first);
  if (it == ring.end()) throw std::invalid_argument("beginning_with: the job is not in the cycle");
  std::ranges::rotate(ring, it);
  return ring;
}

}  // namespace armloom
