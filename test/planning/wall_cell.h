#pragma once

#include <gtest/gtest.h>

#include "core/collision/scene/planning_scene.h"
#include "test/model/test_cells.h"

namespace armloom::testing {

// Two Pandas and an upright board. The board blocks the straight line of the left arm from home to
// the side.
struct WallCell {
  WallCell() {
    CellDescription described = two_pandas_description();
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.translation() = Eigen::Vector3d(-0.34, 0.5, 0.4);
    described.objects.push_back({"board", Box{{0.02, 0.4, 0.5}}, X_WO});
    cell = build_or_fail(described);
    scene = *PlanningScene::build(cell);
  }
  CellPtr cell;
  PlanningScenePtr scene;
  ArmId left{0};
  Eigen::VectorXd home() const { return cell->arm(left).home; }
  // In front of and behind the board.
  Eigen::VectorXd before() const { return reach(0.7); }
  Eigen::VectorXd behind() const { return reach(2.2); }
  static Eigen::VectorXd reach(double turn) {
    Eigen::VectorXd q(7);
    q << turn, 0.2, 0.0, -1.8, 0.0, 2.0, 0.785;
    return q;
  }
  [[nodiscard]] Configuration standing(const Eigen::VectorXd& q) const {
    Configuration whole = cell->home();
    for (std::size_t j = 0; j < 7; ++j) {
      whole[static_cast<Eigen::Index>(cell->arm(left).joints[j].index())] =
          q[static_cast<Eigen::Index>(j)];
    }
    return whole;
  }
};

}  // namespace armloom::testing
