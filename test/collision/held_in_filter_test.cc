#include <gtest/gtest.h>

#include "core/collision/filter/arm_kinematics.h"
#include "core/collision/filter/pair_set.h"
#include "core/collision/scene/link_capsules.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/collision/state/clearance_query.h"
#include "core/geometry/capsule/segment_distance.h"
#include "test/collision/holding_cell.h"

namespace armloom {
namespace {

using namespace holding;

struct Filtered {
  Filtered(const PlanningScene& scene, ArmId arm, const Configuration& state)
      : kinematics(scene.bodies(), arm), frames(kinematics.frames().size() * 12) {
    std::vector<double> q;
    for (const JointId joint : kinematics.joints()) {
      q.push_back(state[static_cast<Eigen::Index>(joint.index())]);
    }
    place_frames(kinematics, q.data(), frames.data());
  }
  [[nodiscard]] LinkCapsule capsule(int index) const {
    const filter::Capsule& capsule = kinematics.capsules()[static_cast<std::size_t>(index)];
    const Eigen::Map<const Eigen::Matrix<double, 3, 4>> X_WF(frames.data() + 12 * capsule.frame);
    const Eigen::Vector3d center =
        X_WF.leftCols<3>() * Eigen::Vector3d(capsule.center) + X_WF.col(3);
    const Eigen::Vector3d half = X_WF.leftCols<3>() * Eigen::Vector3d(capsule.half);
    return {center - half, center + half, static_cast<double>(capsule.radius_up)};
  }
  ArmKinematics kinematics;
  std::vector<double> frames;
};
constexpr double kRounding_m = 1e-9;

std::vector<LinkCapsule> capsules_of(const Filtered& arm, const KinematicBody& part) {
  std::vector<LinkCapsule> capsules;
  for (int c = part.capsules_begin; c < part.capsules_end; ++c) capsules.push_back(arm.capsule(c));
  return capsules;
}

TEST(AttachedObjects, LieInTheirBroadPhaseCapsules) {
  Holding h;
  const auto& bodies = h.scene->bodies();
  int looked_at = 0;
  for (int i = 0; i < 20; ++i) {
    const Configuration q = h.random_configuration();
    LinkPoses X_WL;
    forward_kinematics(*h.cell, q, X_WL);
    for (const ArmId id : {ArmId{0}, ArmId{1}}) {
      const Filtered arm(*h.scene, id, q);
      const ArmKinematics& kinematics = arm.kinematics;
      for (const KinematicBody& placed : kinematics.bodies()) {
        const CollisionBody& part = bodies.bodies[placed.body];
        const Ball& reach = bodies.reach[id.index()];
        for (const LinkCapsule& capsule : capsules_of(arm, placed)) {
          for (const Eigen::Vector3d& end : {capsule.p_PA, capsule.p_PB}) {
            EXPECT_LT((end - reach.center).norm() + capsule.radius_m, reach.radius_m + kRounding_m)
                << part.name;
          }
        }
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
            EXPECT_LT(p_W.cwiseAbs().maxCoeff(), kinematics.extent_m());
            EXPECT_LT((p_W - reach.center).norm() + ball.radius_m, reach.radius_m + kRounding_m);
            ++looked_at;
          }
        }
      }
    }
  }
  EXPECT_GT(looked_at, 20 * 3 * 8);
}

TEST(AttachedObjects, BroadPhaseNeverOverestimatesDistance) {
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
    collect(pairs_between(bodies, left.kinematics, right.kinematics), left, &right);
    for (const Filtered* arm : {&left, &right}) {
      collect(pairs_between(bodies, arm->kinematics, arm->kinematics), *arm, arm);
      collect(pairs_between(bodies, arm->kinematics, still), *arm, nullptr);
    }
    double closest_m = 1e9;
    for (const auto& [pair, distance_m] : brute_force(h, q)) {
      closest_m = std::min(closest_m, distance_m);
      if (pair.first == "table" || pair.second == "table") continue;  // a box has no capsules
      const auto seen = least.find(pair);
      ASSERT_NE(seen, least.end()) << pair.first << " " << pair.second;
      EXPECT_LE(seen->second, distance_m + 1e-6) << pair.first << " " << pair.second;
      ++compared;
    }
    // The kernels must see the attached object too.
    const double limit_m = closest_m + 1e-6;
    const Configuration* state = &q;
    EXPECT_EQ(ClearanceQuery(h.scene, {limit_m, limit_m}).too_close({&state, 1}), 1U);
  }
  EXPECT_GT(compared, 40 * 30);
}

}  // namespace
}  // namespace armloom
