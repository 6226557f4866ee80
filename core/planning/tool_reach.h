#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"

namespace armloom {

// Where the tools of a cell's arms get to: poses on a grid that all arms share.

struct ReachQuestion {
  double step_m = 0.1;  // of the grid
  // The tool, with or without the robot's prefix; absent: the link of each arm's last joint.
  std::optional<std::string> link = {};
};

// Places, x fastest, then y, then z.
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
  Eigen::Vector3d base;                  // where its first joint is (m)
  std::vector<std::uint8_t> directions;  // by place: in so many ways the tool gets there
};

struct ToolReach {
  ReachGrid grid;
  std::vector<ArmReach> arms;  // as the cell has them

  [[nodiscard]] std::size_t poses(const ArmReach& arm) const;   // of the grid's, all directions
  [[nodiscard]] std::size_t places(const ArmReach& arm) const;  // in any direction
  [[nodiscard]] std::size_t shared(const ArmReach& a, const ArmReach& b) const;
};

// At each place the tool's z axis points down, or to one of four sides (x, -x, y, -y of the world).
inline constexpr std::size_t kReachDirections = 5;
inline constexpr std::size_t kReachPlacesMax = 200'000;

// A pose counts as reached where inverse kinematics (pose_goal.h) finds joint positions in which
// the arm keeps its distance from the scene and from itself, other arms gone. The grid covers a
// ball about the first joint of each arm that its tool cannot leave. Deterministic. Problems:
// "--link" (an arm has no such link), "--step" (too many places).
[[nodiscard]] Result<ToolReach> tool_reach(const PlanningScenePtr& scene,
                                           const ReachQuestion& question);

}  // namespace armloom
