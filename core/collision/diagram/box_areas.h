#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/coordination/conflict_region.h"

namespace armloom {

// Boxes that overlap little, with a fast test if a point lies in one of them (a search along axis
// A).
class BoxAreas {
 public:
  // Precondition: `boxes` is not empty.
  explicit BoxAreas(std::vector<ProgressBox> boxes) : boxes_(std::move(boxes)) {
    std::ranges::sort(boxes_, {}, &ProgressBox::from_a);
    hull_ = boxes_.front();
    for (const ProgressBox& box : boxes_) {
      hull_ = {std::min(hull_.from_a, box.from_a), std::max(hull_.to_a, box.to_a),
               std::min(hull_.from_b, box.from_b), std::max(hull_.to_b, box.to_b)};
      to_a_.push_back(hull_.to_a);
    }
  }

  // Returns false only if no point of `box` lies in any of the boxes.
  [[nodiscard]] bool may_hold(const ProgressBox& box) const {
    return box.from_a <= hull_.to_a && hull_.from_a <= box.to_a && box.from_b <= hull_.to_b &&
           hull_.from_b <= box.to_b;
  }
  [[nodiscard]] bool hold(Duration a, Duration b) const {
    const auto behind = std::ranges::upper_bound(boxes_, a, {}, &ProgressBox::from_a);
    for (auto i = static_cast<std::size_t>(behind - boxes_.begin()); i-- > 0 && to_a_[i] >= a;) {
      const ProgressBox& box = boxes_[i];
      if (a <= box.to_a && box.from_b <= b && b <= box.to_b) return true;
    }
    return false;
  }

 private:
  std::vector<ProgressBox> boxes_;  // by from_a
  std::vector<Duration> to_a_;      // by box: largest to_a of it and all previous boxes
  ProgressBox hull_;
};

}  // namespace armloom
