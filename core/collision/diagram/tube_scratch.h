#pragma once

#include <array>
#include <vector>

#include "core/collision/diagram/check_progress.h"
#include "core/collision/diagram/tube_pair.h"

namespace armloom {

// The nodes of a tube that are being placed.
struct MotionTube::Scratch {
  std::vector<double> q;
  struct Motions {
    std::vector<float> span, drift, loose;
  };
  Motions joints;            // [row][kLanes]
  std::vector<float> spans;  // [frame][kLanes]
  std::vector<float> motion_bounds, axes;
  std::vector<int> capsule_rows;  // by capsule: row in Block::motion_bound
  std::vector<filter::Hit> hits;
  std::vector<int> stretches;
  Eigen::VectorXd position;
  Trajectory::AboutLine line;
};

// Copies of nodes from different blocks, one per lane.
struct TubePair::Gathered {
  std::vector<float> capsules, motion_bound, ball;  // MotionTube::Block
};

// The batch that is being filtered, the undecided pairs of one of its cells, and one placed state.
struct TubePair::Scratch {
  CheckProgress* progress = nullptr;  // null if not watched
  Gathered a, b;
  struct Hits {
    std::vector<filter::Hit> of;
    int count = 0;
  };
  Hits pairs, boxes;
  struct Parted {  // of a hit, by lane
    filter::Parted of[filter::kLanes];
  };
  std::vector<Parted> parted;  // by hit of pairs
  std::array<filter::Parted, filter::kLanes> parted_closest;
  std::vector<int> nodes_a, nodes_b;
  bool in_stretches = true;
  filter::Side side_a;
  std::vector<Undecided> undecided;
  std::vector<MovingAxis> axes_a, axes_b;
  struct OneState {
    std::vector<double> frames_a, frames_b, q;
  };
  OneState state;
};

}  // namespace armloom
