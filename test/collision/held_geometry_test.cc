#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "core/collision/check/motion_checker.h"
#include "core/collision/filter/arm_kinematics.h"
#include "core/collision/filter/pair_set.h"
#include "core/collision/scene/link_capsules.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/collision/state/check_home.h"
#include "core/collision/state/clearance_query.h"
#include "core/geometry/capsule/segment_distance.h"
#include "core/geometry/convex/exact_distance.h"
#include "core/model/kinematics.h"
#include "test/collision/scaled_query.h"
#include "test/collision/small_cell.h"
#include "test/geometry/reference_distance.h"
#include "test/geometry/small_meshes.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

// Two Pandas: left holds a box and a rod in its hand, right a mesh on its forearm, all at odd poses
// that are free at home.
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
NamePair names(const std::string& a, const std::string& b) { return std::minmax(a, b); }

// The distances of everything that is held from all that it may not touch, by placing it by hand.
std::map<NamePair, double> brute_force(const Holding& h, const Configuration& q) {
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

TEST(HeldObjects, AreWhereTheirLinksCarryThemForTheChecker) {
  Holding h;
  small::ScaledQuery checker(h.scene);
  const double limit_m = 0.1;
  const double self_limit_m = limit_m * h.cell->self_clearance_m / h.cell->clearance_m;
  std::vector<NearPair> near;
  int close = 0;
  int contacts = 0;
  for (int i = 0; i < 150; ++i) {
    const Configuration q = h.random_configuration();
    near = checker.near(q, limit_m);
    std::map<NamePair, double> seen;
    for (const NearPair& pair : near) {
      const Proximity proximity = checker.describe(pair);
      if (!proximity.held_a && !proximity.held_b) continue;
      seen[names(proximity.body_a, proximity.body_b)] = pair.clearance_m;
    }
    for (const auto& [pair, distance_m] : brute_force(h, q)) {
      const auto own = [&](const char* arm, const char* one, const char* two) {
        const auto belongs = [&](const std::string& name) {
          const bool mount = name.ends_with("panda_link0");  // scene
          return (name.starts_with(arm) && !mount) || name == one || name == two;
        };
        return belongs(pair.first) && belongs(pair.second);
      };
      const bool self = own("left", "crate", "rod") || own("right", "bracket", "bracket");
      const double limit = self ? self_limit_m : limit_m;
      const auto entry = seen.find(pair);
      const double checked = entry == seen.end() ? limit : entry->second;
      EXPECT_NEAR(std::max(0.0, checked), std::min(distance_m, limit), 1e-6)
          << pair.first << " " << pair.second << " in state " << i;
      close += distance_m > 0.0 && distance_m < limit ? 1 : 0;
      contacts += distance_m <= 0.0 ? 1 : 0;
      if (entry != seen.end()) seen.erase(entry);
    }
    EXPECT_TRUE(seen.empty()) << seen.begin()->first.first << " " << seen.begin()->first.second;
  }
  EXPECT_GT(close, 100);
  EXPECT_GT(contacts, 100);
}

// An arm's capsules as the filter has them at one configuration, but in double.
struct Filtered {
  Filtered(const PlanningScene& scene, ArmId arm, const Configuration& state)
      : linkage(scene.bodies(), arm), frames(linkage.frames().size() * 12) {
    std::vector<double> q;
    for (const JointId joint : linkage.joints()) {
      q.push_back(state[static_cast<Eigen::Index>(joint.index())]);
    }
    place_frames(linkage, q.data(), frames.data());
  }
  [[nodiscard]] LinkCapsule capsule(int index) const {
    const filter::Capsule& capsule = linkage.capsules()[static_cast<std::size_t>(index)];
    const Eigen::Map<const Eigen::Matrix<double, 3, 4>> X_WF(frames.data() + 12 * capsule.frame);
    const Eigen::Vector3d center =
        X_WF.leftCols<3>() * Eigen::Vector3d(capsule.center) + X_WF.col(3);
    const Eigen::Vector3d half = X_WF.leftCols<3>() * Eigen::Vector3d(capsule.half);
    return {center - half, center + half, static_cast<double>(capsule.radius_up)};
  }
  ArmKinematics linkage;
  std::vector<double> frames;
};
constexpr double kRounding_m = 1e-9;

std::vector<LinkCapsule> capsules_of(const Filtered& arm, const KinematicBody& part) {
  std::vector<LinkCapsule> capsules;
  for (int c = part.capsules_begin; c < part.capsules_end; ++c) capsules.push_back(arm.capsule(c));
  return capsules;
}

TEST(HeldObjects, LieInTheirCapsulesInTheFilter) {
  Holding h;
  const auto& bodies = h.scene->bodies();
  int looked_at = 0;
  for (int i = 0; i < 20; ++i) {
    const Configuration q = h.random_configuration();
    LinkPoses X_WL;
    forward_kinematics(*h.cell, q, X_WL);
    for (const ArmId id : {ArmId{0}, ArmId{1}}) {
      const Filtered arm(*h.scene, id, q);
      const ArmKinematics& linkage = arm.linkage;
      for (const KinematicBody& placed : linkage.bodies()) {
        const CollisionBody& part = bodies.bodies[placed.body];
        if (!part.held()) continue;
        const Attachment& held = h.scene->attachments()[placed.body - bodies.links_end];
        const Eigen::Isometry3d X_WO = X_WL[held.link.index()] * held.X_LO;
        for (const ConvexShape& body :
             make_convex_shapes(std::vector<PlacedShape>(1, {held.object.shape}))) {
          for (const Ball& ball : extreme_balls(body)) {
            const Eigen::Vector3d p_W = X_WO * ball.center;
            double outside_m = 1e9;
            for (const LinkCapsule& capsule : capsules_of(arm, placed)) {
              outside_m = std::min(
                  outside_m, distance_to_axis(capsule, p_W) + ball.radius_m - capsule.radius_m);
            }
            EXPECT_LT(outside_m, kRounding_m) << part.name;
            EXPECT_LT(p_W.cwiseAbs().maxCoeff(), linkage.extent_m());
            EXPECT_LT((p_W - linkage.root()).norm(), linkage.reach_m());
            ++looked_at;
          }
        }
      }
    }
  }
  EXPECT_GT(looked_at, 20 * 3 * 8);
}

TEST(HeldObjects, AreNeverFartherInTheFilterThanTheyAre) {
  Holding h;
  const auto& bodies = h.scene->bodies();
  const ArmKinematics still(bodies, std::nullopt);
  int compared = 0;
  for (int i = 0; i < 40; ++i) {
    const Configuration q = h.random_configuration();
    const Filtered left(*h.scene, ArmId{0}, q);
    const Filtered right(*h.scene, ArmId{1}, q);
    std::map<NamePair, double> least;
    const auto collect = [&](const PairSet& set, const Filtered& a, const Filtered* b) {
      const auto add = [&](const NarrowPair& narrow, double distance_m) {
        const BodyPair& pair = bodies.pairs[narrow.pair.index()];
        const NamePair key = names(bodies.bodies[pair.a].name, bodies.bodies[pair.b].name);
        const auto [entry, fresh] = least.emplace(key, distance_m);
        if (!fresh) entry->second = std::min(entry->second, distance_m);
      };
      for (std::size_t k = 0; k < set.pairs.size(); ++k) {
        const LinkCapsule one = a.capsule(set.pairs[k].a);
        LinkCapsule other;
        if (b != nullptr) {
          other = b->capsule(set.pairs[k].b);
        } else {
          const filter::Capsule& c = still.capsules()[static_cast<std::size_t>(set.pairs[k].b)];
          const Eigen::Vector3d center(c.center);
          const Eigen::Vector3d half(c.half);
          other = {center - half, center + half, static_cast<double>(c.radius_up)};
        }
        const auto segment = [](const LinkCapsule& c) {
          return CenteredSegment{0.5 * (c.p_PA + c.p_PB), 0.5 * (c.p_PB - c.p_PA)};
        };
        const double axes_m = segment_segment_distance(segment(one), segment(other));
        add(set.narrow[k], axes_m - one.radius_m - other.radius_m);
      }
    };
    collect(pairs_between(bodies, left.linkage, right.linkage), left, &right);
    for (const Filtered* arm : {&left, &right}) {
      collect(pairs_between(bodies, arm->linkage, arm->linkage), *arm, arm);
      collect(pairs_between(bodies, arm->linkage, still), *arm, nullptr);
    }
    double closest_m = 1e9;
    for (const auto& [pair, distance_m] : brute_force(h, q)) {
      closest_m = std::min(closest_m, distance_m);
      if (pair.first == "table" || pair.second == "table") continue;  // a box: no capsules
      const auto seen = least.find(pair);
      ASSERT_NE(seen, least.end()) << pair.first << " " << pair.second;
      EXPECT_LE(seen->second, distance_m + 1e-6) << pair.first << " " << pair.second;
      ++compared;
    }
    // And in the kernels: what is held is closer than this.
    const double limit_m = closest_m + 1e-6;
    const Configuration* state = &q;
    EXPECT_EQ(ClearanceQuery(h.scene, {limit_m, limit_m}).too_close({&state, 1}), 1U);
  }
  EXPECT_GT(compared, 40 * 30);
}

// With a limit that only what is held breaks, and just not: the kernels see what is there.
TEST(HeldObjects, AreAllThatIsCloseToAHandThatIsAlone) {
  Holding h;
  int alone = 0;
  for (int i = 0; i < 200; ++i) {
    const Configuration q = h.random_configuration();
    double closest_m = 1e9;
    for (const auto& [pair, d] : brute_force(h, q)) closest_m = std::min(closest_m, d);
    if (closest_m < 1e-4) continue;
    const Configuration* state = &q;
    const PairLimits above{closest_m + 1e-5, closest_m + 1e-5};
    const PairLimits below{closest_m - 1e-5, closest_m - 1e-5};
    if (ClearanceQuery(h.bare, above).too_close({&state, 1}) != 0) continue;
    EXPECT_EQ(ClearanceQuery(h.scene, above).too_close({&state, 1}), 1U);
    EXPECT_EQ(ClearanceQuery(h.scene, below).too_close({&state, 1}), 0U);
    ++alone;
  }
  EXPECT_GT(alone, 3);
}

// What is certified stays free at every millisecond, with what the arms hold.
TEST(HeldObjects, KeepTheClearanceAllAlongSweptMotions) {
  Holding h;
  MotionChecker motion_checker(h.scene);
  MotionChecker of_bare(h.bare);
  small::ScaledQuery checker(h.scene);
  int free = 0;
  int because_held = 0;
  const Configuration home = h.cell->home();
  for (int i = 0; i < 60; ++i) {
    const auto towards = [&](ArmId arm, const Configuration& to, double share) {
      std::vector<double> values;
      for (const JointId joint : h.cell->arm(arm).joints) {
        const auto k = static_cast<Eigen::Index>(joint.index());
        values.push_back(home[k] + share * (to[k] - home[k]));
      }
      return values;
    };
    const Configuration to = h.random_configuration();
    const Motion candidate{JobId{1},
                           small::sweep(*h.cell, {ArmId{0}}, towards(ArmId{0}, to, 0.0),
                                        towards(ArmId{0}, to, 0.3), 2s),
                           0s};
    const Motion other{JobId{2},
                       small::sweep(*h.cell, {ArmId{1}}, towards(ArmId{1}, to, 0.0),
                                    towards(ArmId{1}, to, 0.3), 3s),
                       500ms};
    const Question question{1, at(0s), {candidate}, {other}, home, Swept{0.0}};
    const Verdict verdict = motion_checker.judge(question);
    if (verdict.kind != Verdict::Kind::free) {
      because_held += of_bare.judge(question).kind == Verdict::Kind::free ? 1 : 0;
      continue;
    }
    ++free;
    Configuration q = home;
    Eigen::VectorXd positions;
    for (Duration t = 0s; t <= 2500ms; t += 1ms) {
      for (const Motion& motion : {candidate, other}) {
        motion.trajectory->sample_positions(
            std::min(motion.progress + t, motion.trajectory->duration()), positions);
        for (std::size_t k = 0; k < motion.trajectory->joints().size(); ++k) {
          q[static_cast<Eigen::Index>(motion.trajectory->joints()[k].index())] =
              positions[static_cast<Eigen::Index>(k)];
        }
      }
      const auto near =
          checker.first_closer_than(q, h.cell->clearance_m - 1e-6, std::vector<bool>{true, false});
      ASSERT_FALSE(near.has_value())
          << near->body_a << " " << near->body_b << " at " << to_seconds(t) << " s of pair " << i;
    }
  }
  EXPECT_GT(free, 5);
  EXPECT_GT(because_held, 5);
}

}  // namespace
}  // namespace armloom
