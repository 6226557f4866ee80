#pragma once

#include "test/collision/small_cell.h"

namespace armloom::small {

enum class As { object, link, mount };

// Two planar two-joint arms and a wall: an object, a static link, or the link that carries the
// first arm. That arm's mount always has a shape.
inline CellPtr walled(As as) {
  Cell cell;
  const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();
  cell.clearances.clearance_m = 0.02;
  cell.clearances.self_clearance_m = 0.005;
  const Eigen::Isometry3d X_WT = at_xyz(0, 0.45, 0);
  const Box wall{{2.5, 0.1, 0.4}};
  if (as == As::link) {
    Link link = static_link("wall", RobotId{0}, X_WT);
    add_shape(link, wall, Eigen::Isometry3d::Identity());
    add_link(cell, link);
  } else if (as == As::object) {
    cell.objects.push_back({"wall", wall, X_WT});
  }
  add_robot(cell, "a", at_xyz(0, 0, 0), {kZ, kZ}, {0.3, 0.03});
  const LinkId base = *cell.find_link("a_base");
  add_shape(cell.links[base.index()], Cylinder{0.02, 0.3}, at_xyz(0, 0, -0.25));
  if (as == As::mount) {
    add_shape(cell.links[base.index()], wall, X_WT);
    cell.links[base.index()].name = "wall";
  }
  add_robot(cell, "b", at_xyz(1.1, 0, 0), {kZ, kZ}, {0.3, 0.03});
  for (Link& link : cell.links) link.robot = RobotId{0};  // one URDF for both
  for (Arm& arm : cell.arms) arm.robot = RobotId{0};
  return shared(cell);
}

}  // namespace armloom::small
