#pragma once

#include <cstddef>
#include <vector>

#include "core/collision/state/part_distance.h"

namespace armloom {

// The bodies of one part, group after group: those that stand for one solid stand together.
class PartGroups {
 public:
  PartGroups(const std::vector<ConvexShape>& bodies, const PlacedPart& part)
      : bodies_(bodies), part_(part), begin_(part.part.bodies_begin) {
    find_end();
  }
  [[nodiscard]] bool ended() const { return begin_ == part_.part.bodies_end; }
  void next() {
    begin_ = end_;
    find_end();
  }
  [[nodiscard]] std::size_t begin() const { return begin_; }
  [[nodiscard]] std::size_t end() const { return end_; }
  [[nodiscard]] const Solid& solid() const { return *bodies_[begin_].solid; }
  [[nodiscard]] Eigen::Isometry3d X_WT() const { return part_.X_WP * solid().X_PT; }
  [[nodiscard]] bool are_pieces() const { return bodies_[begin_].is_piece; }

  [[nodiscard]] const PlacedConvexShape& placed(std::size_t body, PlacedConvexShape& own) const {
    place(bodies_[body], part_.X_WP, own);
    return own;
  }

 private:
  void find_end() {
    end_ = begin_;
    while (end_ < part_.part.bodies_end && bodies_[end_].solid == bodies_[begin_].solid) ++end_;
  }

  const std::vector<ConvexShape>& bodies_;
  const PlacedPart& part_;
  std::size_t begin_;
  std::size_t end_ = 0;
};

}  // namespace armloom
