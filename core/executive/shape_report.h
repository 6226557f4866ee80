#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// What the collision checks make of one link or object.
struct ShapeReport {
  std::string body;               // the link's or object's name
  std::size_t convex_shapes = 0;  // exact; a mesh counts as many as it has pieces
  std::size_t capsules = 0;       // of the cheap filter, around them
  double excess_m = 0.0;          // how far the capsules stand off the shapes, measured
};

// Of every link that has a shape, in the cell's order, then of every object. Problems: as
// PlanningScene::build.
[[nodiscard]] Result<std::vector<ShapeReport>> report_shapes(CellPtr cell);

}  // namespace armloom
