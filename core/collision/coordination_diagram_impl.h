#pragma once

#include <vector>

#include "core/collision/coordination_diagram.h"
#include "core/collision/filter/kernel.h"

// What the two sources of CoordinationDiagram share: coordination_diagram.cc has the tree and its
// questions, coordination_cells.cc decides batches of cells.
namespace armloom {

// Wider stretches of a motion are hardly ever free in one: they are halved unseen.
inline constexpr Duration kWide = std::chrono::milliseconds(700);

// One side of a batch of cells that lie apart.
struct CoordinationDiagram::Gathered {
  std::vector<float> capsules;   // [capsule][6][kLanes]
  std::vector<float> inflation;  // [capsule][kLanes]
  std::vector<float> ball;       // [4][kLanes]
  std::vector<float> axes;       // [frame][6][kLanes]
  std::vector<float> spans;      // [frame][kLanes]
  std::vector<float> bends;      // [capsule][kLanes]
};

// A pair that the filter leaves open in a cell.
struct CoordinationDiagram::Undecided {
  int narrow;  // in PairSet::narrow, or narrow_boxes
  bool box;
  double distance_m;  // lower bound at the middle
  double moves_a_m;   // during the cell
  double moves_b_m;
  double limit_m;
  double slack_m;  // by how much the exact distance may be above the bound

  [[nodiscard]] double moves_m() const { return moves_a_m + moves_b_m; }
};

// Of the batch, the cell, or the state at hand.
struct CoordinationDiagram::Scratch {
  struct Point {  // frames and joints of one state
    std::vector<double> a;
    std::vector<double> b;
    std::vector<double> q;
  };

  Gathered a, b;
  std::vector<filter::Hit> hits, box_hits;
  std::vector<Undecided> undecided;  // of one cell
  std::vector<MovingAxis> axes_a, axes_b;
  Point point;
  std::vector<int> nodes;
  std::vector<int> open;  // of a walk through the tree
};

}  // namespace armloom
