#pragma once

#include <cstddef>
#include <vector>

#include "core/collision/state/body_distance.h"

namespace armloom {

// Iterates over groups of a body's shapes. Shapes of the same solid are one group; if `whole`, all
// shapes are one group.
class ShapeGroups {
 public:
  ShapeGroups(const std::vector<ConvexShape>& shapes, const PlacedBody& body, bool whole = false)
      : shapes_(shapes), body_(body), whole_(whole), begin_(body.body.shapes_begin) {
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

  void place(std::size_t shape, PlacedConvexShape& at) const {
    armloom::place(shapes_[shape], body_.X_WP, at);
  }

 private:
  void find_end() {
    end_ = begin_;
    const auto continues = [&] { return whole_ || shapes_[end_].solid == shapes_[begin_].solid; };
    while (end_ < body_.body.shapes_end && continues()) ++end_;
  }

  const std::vector<ConvexShape>& shapes_;
  const PlacedBody& body_;
  bool whole_;
  std::size_t begin_;
  std::size_t end_ = 0;
};

}  // namespace armloom
