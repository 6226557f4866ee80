#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

// Internal to core/planning: interface to OMPL.
namespace armloom {

// Bounds of samples for each joint, all finite.
struct JointRoom {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

struct TreeSearch {
  JointRoom room;
  Eigen::VectorXd start;
  std::vector<Eigen::VectorXd> goals;
  double step;  // maximum length of an edge
  std::uint64_t seed;
  // Returns true if the arm may move from the first to the second position in a straight line in
  // joint space.
  std::function<bool(const Eigen::VectorXd&, const Eigen::VectorXd&)> is_free;
  std::function<bool()> stop;  // polled between edges
};

// Runs OMPL's RRT-Connect. Returns the points from the start to a goal, or nullopt if `stop` ended
// the search. Samples depend on `seed` only.
[[nodiscard]] std::optional<std::vector<Eigen::VectorXd>> grow_trees(const TreeSearch& search);

}  // namespace armloom
