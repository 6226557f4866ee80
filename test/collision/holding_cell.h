#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "core/collision/state/check_home.h"
#include "core/geometry/convex/exact_distance.h"
#include "core/model/kinematics.h"
#include "test/collision/small_cell.h"
#include "test/geometry/reference_distance.h"
#include "test/geometry/small_meshes.h"
#include "test/model/test_cells.h"

namespace armloom::holding {

// Two Pandas: left has a box and a rod attached to its hand, right a mesh on its forearm.
struct Holding {
  CellPtr cell = build_or_fail(two_pandas_description());
  std::mt19937_64 random{404};
  PlanningScenePtr bare = *PlanningScene::build(cell);
  PlanningScenePtr scene = hold();

  PlanningScenePtr hold() {
    const auto odd = [&](std::string name, const Shape& shape, const char* link) {
      Attachment held{{std::move(name), shape}, *cell->find_link(link)};
      held.X_LO = reference::random_pose(random, 0.15);
      return held;
    };
    const Shape mesh = small::mesh_of(small::box_surface({-0.1, -0.03, 0.0}, {0.15, 0.05, 0.3}));
    for (int tries = 0; tries < 1000; ++tries) {
      auto held =
          *bare->with_attachments({odd("crate", Box{{0.2, 0.1, 0.3}}, "left_panda_hand"),
                                   odd("rod", Cylinder{0.015, 0.5}, "left_panda_leftfinger"),
                                   odd("bracket", mesh, "right_panda_link5")});
      if (check_home(held).empty()) return held;
    }
    ADD_FAILURE() << "no pose is free at home";
    return bare;
  }

  Configuration random_configuration() {
    Configuration q = cell->home();
    for (std::size_t i = 0; i < cell->joints.size(); ++i) {
      const Joint& joint = cell->joints[i];
      q[static_cast<Eigen::Index>(i)] =
          std::uniform_real_distribution<double>(joint.lower, joint.upper)(random);
    }
    return q;
  }
};

using NamePair = std::pair<std::string, std::string>;
inline NamePair names(const std::string& a, const std::string& b) { return std::minmax(a, b); }

// Returns the distance of each attached object to each body that the object must not touch.
inline std::map<NamePair, double> brute_force(const Holding& h, const Configuration& q) {
  LinkPoses X_WL;
  forward_kinematics(*h.cell, q, X_WL);
  struct Solid {
    std::string name;
    std::vector<ConvexShape> shapes;
    Eigen::Isometry3d X_WP;
    bool held;
  };
  std::vector<Solid> solids;
  for (const Attachment& held : h.scene->attachments()) {
    solids.push_back({held.object.name,
                      make_convex_shapes(std::vector<PlacedShape>(1, {held.object.shape})),
                      X_WL[held.link.index()] * held.X_LO, true});
  }
  for (std::size_t i = 0; i < h.cell->links.size(); ++i) {
    if (h.cell->links[i].shapes.empty()) continue;
    solids.push_back(
        {h.cell->links[i].name, make_convex_shapes(h.cell->links[i].shapes), X_WL[i], false});
  }
  for (const CollisionObject& o : h.cell->objects) {
    solids.push_back(
        {o.name, make_convex_shapes(std::vector<PlacedShape>(1, {o.shape})), o.X_WO, false});
  }
  const std::set<std::string> hand{"left_panda_link7", "left_panda_hand", "left_panda_leftfinger",
                                   "left_panda_rightfinger"};
  std::map<NamePair, double> found;
  for (const Solid& a : solids) {
    for (const Solid& b : solids) {
      if (&a >= &b || !a.held) continue;
      const bool left = a.name != "bracket";
      if (left && (hand.contains(b.name) || (b.held && b.name != "bracket"))) continue;
      if (!left && b.name == "right_panda_link5") continue;
      double smallest = 1e9;
      for (const ConvexShape& x : a.shapes) {
        for (const ConvexShape& y : b.shapes) {
          smallest = std::min(smallest, exact_distance(x, a.X_WP * x.X_PS, y, b.X_WP * y.X_PS));
        }
      }
      found[names(a.name, b.name)] = smallest;
    }
  }
  return found;
}

}  // namespace armloom::holding
