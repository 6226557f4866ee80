#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// The collision shapes of one link or object.
struct ShapeReport {
  std::string body;               // the link's or object's name
  std::size_t convex_shapes = 0;  // exact shapes; a mesh has one per convex piece
  std::size_t capsules = 0;       // around them, for the conservative filter
  double excess_m = 0.0;          // measured gap by which the capsules exceed the shapes
};

// Returns a report of every link that has a shape, in the cell's order, then of every object.
// Problems: those of PlanningScene::build.
[[nodiscard]] Result<std::vector<ShapeReport>> report_shapes(CellPtr cell);

}  // namespace armloom
