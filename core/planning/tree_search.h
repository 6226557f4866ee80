#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

// Inside of core/planning: the door to OMPL.
namespace armloom {

// The room that a search samples: a lower and an upper bound for each joint, all finite.
struct JointRoom {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

struct TreeSearch {
  JointRoom room;
  Eigen::VectorXd start;
  std::vector<Eigen::VectorXd> goals;
  double step;  // no edge is longer
  std::uint64_t seed;
  // Whether the arm may move straight from the first to the second.
  std::function<bool(const Eigen::VectorXd&, const Eigen::VectorXd&)> is_free;
  std::function<bool()> stop;  // asked between edges
};

// OMPL's RRT-Connect; the points from the start to one of the goals, or nothing when it was
// stopped. Samples come from `seed` alone.
[[nodiscard]] std::optional<std::vector<Eigen::VectorXd>> grow_trees(const TreeSearch& search);

}  // namespace armloom
