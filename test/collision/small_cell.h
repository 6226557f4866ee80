#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

// Handmade cells, so that these tests depend on no file.
namespace armloom::small {

inline constexpr double kHalfTurn = 3.14159265358979323846;

inline Eigen::Isometry3d at_xyz(double x, double y, double z) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = Eigen::Vector3d(x, y, z);
  return X;
}

// Returns a capsule along x, as in URDF: a cylinder and two spheres.
inline std::vector<PlacedShape> capsule_along_x(double from, double to, double radius) {
  Eigen::Isometry3d X_LS = at_xyz((from + to) / 2, 0, 0);
  X_LS.linear() = Eigen::AngleAxisd(kHalfTurn / 2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return {{Cylinder{radius, to - from}, X_LS},
          {Sphere{radius}, at_xyz(from, 0, 0)},
          {Sphere{radius}, at_xyz(to, 0, 0)}};
}

inline Link static_link(std::string name, RobotId robot, const Eigen::Isometry3d& X_WL) {
  Link link{std::move(name),          robot, {},  {}, X_WL, {}, JointKind::revolute,
            Eigen::Vector3d::UnitZ(), 1.0,   0.0, {}};
  return link;
}

// Not inline, because of false -Wmaybe-uninitialized warnings of GCC 12.
void add_shape(Link& link, const Shape& shape, const Eigen::Isometry3d& X_LS);

inline LinkId add_link(Cell& cell, Link link) {
  cell.links.push_back(std::move(link));
  return LinkId{static_cast<std::uint32_t>(cell.links.size() - 1)};
}

struct LinkSize {
  double length_m;
  double radius_m;
};
// Adds an arm on a static base without shape. It has one capsule per axis, joined end to end along
// x. Adjacent links may touch.
inline ArmId add_robot(Cell& cell, const std::string& name, const Eigen::Isometry3d& X_WB,
                       const std::vector<Eigen::Vector3d>& axes, const LinkSize& size) {
  const RobotId robot{static_cast<std::uint32_t>(cell.robots.size())};
  const ArmId arm_id{static_cast<std::uint32_t>(cell.arms.size())};
  Arm arm{name, robot, name, {}, {}, {}, {}, {}};
  LinkId parent = add_link(cell, static_link(name + "_base", robot, X_WB));
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const JointId joint{static_cast<std::uint32_t>(cell.joints.size())};
    const double inf = std::numeric_limits<double>::infinity();
    cell.joints.push_back({name + "_joint" + std::to_string(i + 1), robot, arm_id,
                           JointKind::continuous, -inf, inf, 2.0, 5.0, 1000.0, 10.0});
    Link link = static_link(name + "_link" + std::to_string(i + 1), robot,
                            at_xyz(i == 0 ? 0.0 : size.length_m, 0, 0));
    link.arm = arm_id;
    link.parent = parent;
    link.driver = joint;
    link.axis = axes[i];
    link.shapes = capsule_along_x(0.0, size.length_m, size.radius_m);
    const LinkId id = add_link(cell, link);
    if (i > 0) cell.allowed.link_pairs.insert({parent, id});
    arm.joints.push_back(joint);
    arm.links.push_back(id);
    parent = id;
  }
  arm.home = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(axes.size()));
  Robot made;
  made.name = name;
  made.X_WB = X_WB;
  made.arms = {arm_id};
  cell.robots.push_back(made);
  cell.arms.push_back(arm);
  return arm_id;
}

inline CellPtr shared(Cell cell) { return std::make_shared<const Cell>(std::move(cell)); }

// Returns a cubic motion from `from` to `to` (rad, every joint), at rest at both ends.
inline TrajectoryPtr sweep(const Cell& cell, const std::vector<ArmId>& arms,
                           const std::vector<double>& from, const std::vector<double>& to,
                           Duration duration) {
  std::vector<JointId> joints;
  for (const ArmId arm : arms) {
    for (const JointId joint : cell.arm(arm).joints) joints.push_back(joint);
  }
  const double T = to_seconds(duration);
  Segment segment{Duration::zero(), duration, {}};
  segment.coefficients.setZero(static_cast<Eigen::Index>(joints.size()), 6);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double way = to[i] - from[i];
    segment.coefficients(row, 0) = from[i];
    segment.coefficients(row, 2) = 3.0 * way / (T * T);
    segment.coefficients(row, 3) = -2.0 * way / (T * T * T);
  }
  return std::make_shared<const Trajectory>(joints, arms, std::vector<Segment>{segment});
}

}  // namespace armloom::small
