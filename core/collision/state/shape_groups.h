#pragma once

#include <cstddef>
#include <vector>

#include "core/collision/state/body_distance.h"

namespace armloom {

// Iterates over groups of a body's shapes. Shapes of the same solid are one group.
class ShapeGroups {
 public:
  ShapeGroups(const std::vector<ConvexShape>& shapes, const PlacedBody& body)
      : shapes_(shapes), body_(body), begin_(body.body.shapes_begin) {
    find_end();
  }
  [[nodiscard]] bool ended() const { return begin_ == body_.body.shapes_end; }
  void next() {
    begin_ = end_;
    find_end();
  }
  [[nodiscard]] std::size_t begin() const { return begin_; }
  [[nodiscard]] std::size_t end() const { return end_; }
  [[nodiscard]] PlacedSolid solid() const {
    const Solid& solid = *shapes_[begin_].solid;
    return {solid, body_.X_WP * solid.X_PT};
  }
  [[nodiscard]] bool are_pieces() const { return shapes_[begin_].is_piece; }

  [[nodiscard]] const PlacedConvexShape& placed(std::size_t shape, PlacedConvexShape& own) const {
    place(shapes_[shape], body_.X_WP, own);
    return own;
  }

 private:
  void find_end() {
    end_ = begin_;
    while (end_ < body_.body.shapes_end && shapes_[end_].solid == shapes_[begin_].solid) ++end_;
  }

  const std::vector<ConvexShape>& shapes_;
  const PlacedBody& body_;
  std::size_t begin_;
  std::size_t end_ = 0;
};

}  // namespace armloom
