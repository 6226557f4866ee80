#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"

namespace armloom {

// The poses that the tools of a cell's arms reach, on a grid that all arms share.

struct ReachQuestion {
  double step_m = 0.1;  // of the grid
  // The tool, with or without the robot's prefix; by default the link of each arm's last joint.
  std::optional<std::string> link = {};
  // Called after each place with the share of the work that is done, 0 to 1. May be null. Called on
  // several threads at once.
  std::function<void(double)> on_progress = {};
};

// Grid points, x fastest, then y, then z.
struct ReachGrid {
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  // in the world (m)
  double step_m = 0.0;
  std::array<int, 3> count = {0, 0, 0};

  [[nodiscard]] std::size_t places() const;
  [[nodiscard]] Eigen::Vector3d at(std::size_t place) const;
};

struct ArmReach {
  ArmId arm;
  LinkId tool;
  Eigen::Vector3d base;                  // position of its first joint in the world (m)
  std::vector<std::uint8_t> directions;  // by place: number of directions reached
};

struct ToolReach {
  ReachGrid grid;
  std::vector<ArmReach> arms;  // in the cell's order

  [[nodiscard]] std::size_t poses(const ArmReach& arm) const;   // reached, in all directions
  [[nodiscard]] std::size_t places(const ArmReach& arm) const;  // reached in any direction
  [[nodiscard]] std::size_t shared(const ArmReach& a, const ArmReach& b) const;
};

// At each place the tool's z axis points down, or to one of four sides (x, -x, y, -y of the world).
inline constexpr std::size_t kReachDirections = 5;
inline constexpr std::size_t kReachPlacesMax = 200'000;

// Counts the poses that each arm's tool reaches on the grid. A pose is reached if inverse
// kinematics (pose_goal.h) finds joint positions at which the arm keeps its clearance from the
// scene and itself. Other arms are ignored. The grid covers a ball around each arm's first joint
// that the arm's tool cannot leave. Deterministic; uses all cores. Problems: "--link" (an arm has
// no such link),
// "--step" (the grid has too many places).
[[nodiscard]] Result<ToolReach> tool_reach(const PlanningScenePtr& scene,
                                           const ReachQuestion& question);

}  // namespace armloom
