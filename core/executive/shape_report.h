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
  std::size_t convex_shapes = 0;  // number of exact shapes; a mesh has one per convex piece
  std::size_t capsules = 0;  // number of capsules around the shapes, for the first, coarse check
  double excess_m = 0.0;     // by how much the capsules stand off the shapes, measured
};

// Returns a report of every link that has a shape, in the cell's order, then of every object.
// Problems: those of PlanningScene::build.
[[nodiscard]] Result<std::vector<ShapeReport>> report_shapes(CellPtr cell);

}  // namespace armloom
