#pragma once

#include <gtest/gtest.h>

#include "core/collision/state/clearance_query.h"
#include "test/collision/small_cell.h"

namespace armloom::busy {

inline const Eigen::Vector3d kX = Eigen::Vector3d::UnitX();
inline const Eigen::Vector3d kY = Eigen::Vector3d::UnitY();
inline const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();

// Two four-link arms face to face over a table, with a rod, a crate, and a static post on the left
// robot. The right arm's last link has a flat cylinder and a box.
inline Cell busy_cell() {
  Cell cell;
  cell.clearances.clearance_m = 0.02;
  small::add_robot(cell, "left", small::at_xyz(-0.3, 0, 0.4), {kZ, kY, kY, kX}, {0.2, 0.05});
  Eigen::Isometry3d facing = small::at_xyz(0.3, 0, 0.4);
  facing.rotate(Eigen::AngleAxisd(small::kHalfTurn, kZ));
  small::add_robot(cell, "right", facing, {kZ, kY, kY, kX}, {0.2, 0.05});
  cell.links.back().shapes.clear();
  small::add_shape(cell.links.back(), Cylinder{0.04, 0.1}, small::at_xyz(0.1, 0, 0));
  small::add_shape(cell.links.back(), Box{{0.05, 0.1, 0.02}}, small::at_xyz(0.15, 0, 0.03));
  Link post = small::static_link("left_post", RobotId{0}, small::at_xyz(-0.3, 0.3, 0.5));
  small::add_shape(post, Box{{0.05, 0.05, 0.6}}, Eigen::Isometry3d::Identity());
  small::add_link(cell, post);
  cell.objects.push_back({"table", Box{{2, 2, 0.1}}, small::at_xyz(0, 0, -0.05)});
  Eigen::Isometry3d leaning = small::at_xyz(0.0, 0.3, 0.3);
  leaning.rotate(Eigen::AngleAxisd(0.7, kX));
  cell.objects.push_back({"rod", Cylinder{0.015, 0.5}, leaning});
  cell.objects.push_back({"crate", Box{{0.2, 0.3, 0.2}}, small::at_xyz(0.1, -0.4, 0.1)});
  cell.objects.push_back({"ball", Sphere{0.1}, small::at_xyz(-0.2, 0.5, 0.5)});
  cell.allowed.link_objects.insert({LinkId{1}, "table"});
  return cell;
}

inline PlanningScenePtr scene_of(const CellPtr& cell) {
  auto scene = PlanningScene::build(cell);
  EXPECT_TRUE(scene.has_value());
  return *scene;
}

}  // namespace armloom::busy
