#include "test/experiments/shortest_way.h"

#include <algorithm>
#include <utility>

namespace armloom::experiments {

ShortestWay::ShortestWay(std::vector<std::size_t> ready)
    : ready_(std::move(ready)), earliest_(ready_.size(), kNever) {}

void ShortestWay::add_row(std::span<const char> blocked, std::size_t ready) {
  std::size_t above_left = kNever;  // of the previous row
  std::size_t left = kNever;
  for (std::size_t column = 0; column < ready_.size(); ++column) {
    const std::size_t above = earliest_[column];
    std::size_t before = std::min({left, above, above_left});
    if (before != kNever) ++before;
    if (!begun_ && column == 0) before = 0;
    left = blocked[column] != 0 || before == kNever ? kNever
                                                    : std::max({before, ready, ready_[column]});
    earliest_[column] = left;
    above_left = above;
  }
  begun_ = true;
}

std::optional<std::size_t> ShortestWay::steps() const {
  if (earliest_.empty() || earliest_.back() == kNever) return std::nullopt;
  return earliest_.back();
}

}  // namespace armloom::experiments
