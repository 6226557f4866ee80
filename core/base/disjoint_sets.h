#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace armloom {

// Union-find. The smallest member identifies its set.
class DisjointSets {
 public:
  // Adds a set of one member.
  void add() { parents_.push_back(parents_.size()); }
  [[nodiscard]] std::size_t root(std::size_t member) {
    while (parents_[member] != member) member = parents_[member] = parents_[parents_[member]];
    return member;
  }
  void join(std::size_t x, std::size_t y) {
    const std::size_t one = root(x);
    const std::size_t other = root(y);
    parents_[std::max(one, other)] = std::min(one, other);
  }

 private:
  std::vector<std::size_t> parents_;
};

}  // namespace armloom
