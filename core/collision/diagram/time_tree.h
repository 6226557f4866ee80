#pragma once

#include <vector>

#include "core/base/time.h"

namespace armloom {

// The time of a motion as a binary tree of intervals. Nodes are created on first use. An arm at
// rest has one node of zero width, which covers all times.
class TimeTree {
 public:
  explicit TimeTree(Duration duration = {}) : nodes_{{Duration{}, duration}} {}

  // Forgets all nodes but the root, which becomes this long.
  void restart(Duration duration) { nodes_.assign(1, {Duration{}, duration}); }
  [[nodiscard]] Duration duration() const { return nodes_.front().to; }
  // The root is the whole motion. The children of a node n are its two halves: first_child(n) and
  // the next node.
  [[nodiscard]] static int root() { return 0; }
  [[nodiscard]] int first_child(int node) {
    if (at(node).children < 0) {
      const Node whole = at(node);
      nodes_[static_cast<std::size_t>(node)].children = static_cast<int>(nodes_.size());
      nodes_.push_back({whole.from, middle(node)});
      nodes_.push_back({nodes_.back().to, whole.to});
    }
    return at(node).children;
  }
  [[nodiscard]] Duration from(int node) const { return at(node).from; }
  [[nodiscard]] Duration to(int node) const { return at(node).to; }
  [[nodiscard]] Duration middle(int node) const { return at(node).from + width(node) / 2; }
  [[nodiscard]] Duration width(int node) const { return at(node).to - at(node).from; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

 private:
  struct Node {
    Duration from;
    Duration to;
    int children = -1;
  };
  [[nodiscard]] const Node& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }

  std::vector<Node> nodes_;
};

}  // namespace armloom
