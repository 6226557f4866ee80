#include "test/collision/small_cell.h"

namespace armloom::small {

void add_shape(Link& link, const Shape& shape, const Eigen::Isometry3d& X_LS) {
  PlacedShape& placed = link.shapes.emplace_back();
  placed.shape = shape;
  placed.X_LS = X_LS;
}

}  // namespace armloom::small
