#include "core/collision/check/line_checker.h"

#include <gtest/gtest.h>

#include <random>

#include "core/collision/check/motion_checker.h"
#include "core/collision/state/clearance_query.h"
#include "core/trajectory/joint_line.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

constexpr double kTrackingError = 0.001;

// Lines of the left Panda near home, with the right Panda at rest.
struct Lines {
  explicit Lines(std::uint64_t seed) : random(seed) {}

  [[nodiscard]] Eigen::VectorXd near_home(ArmId arm, double share) {
    Eigen::VectorXd q = cell->arm(arm).home;
    for (std::size_t j = 0; j < cell->arm(arm).joints.size(); ++j) {
      const Joint& joint = cell->joint(cell->arm(arm).joints[j]);
      const auto row = static_cast<Eigen::Index>(j);
      const double there = std::uniform_real_distribution(joint.lower, joint.upper)(random);
      q[row] += share * (there - q[row]);
    }
    return q;
  }
  void put(Configuration& q, ArmId arm, const Eigen::VectorXd& own) const {
    for (std::size_t j = 0; j < cell->arm(arm).joints.size(); ++j) {
      q[static_cast<Eigen::Index>(cell->arm(arm).joints[j].index())] =
          own[static_cast<Eigen::Index>(j)];
    }
  }

  CellPtr cell = build_or_fail(two_pandas_description());
  PlanningScenePtr scene = *PlanningScene::build(cell);
  std::mt19937_64 random;
};

// Confirms each answer with the motion checker, and with exact distances at states that are off the
// line by up to the tracking error.
TEST(LineChecker, AgreesWithStateChecksAndMotionChecker) {
  Lines lines(21);
  const ArmId left{0}, right{1};
  ClearanceQuery states(lines.scene);
  MotionChecker judge(lines.scene);
  const std::vector<bool> all(lines.cell->arms.size(), true);
  std::vector<NearPair> near;
  int free = 0, conflicts = 0, undecided = 0, judged_free = 0;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    Configuration rest = lines.cell->home();
    lines.put(rest, right, lines.near_home(right, 0.5));
    const Eigen::VectorXd from = lines.near_home(left, 0.5);
    const Eigen::VectorXd to = lines.near_home(left, 0.5);
    LineChecker checker(lines.scene, left, rest, kTrackingError);
    const auto answer = checker.line(from, to);
    EXPECT_EQ(checker.is_free(from, to), answer.kind == LineChecker::Kind::free);
    // Checks all pairs except those of the right arm alone.
    const auto too_close = [&](const Eigen::VectorXd& q) {
      Configuration whole = rest;
      lines.put(whole, left, q);
      states.near_pairs(whole, {true, false}, all, near);
      return !near.empty();
    };
    const auto trajectory = joint_line(*lines.cell, lines.cell->arm(left).joints, from, to);
    ASSERT_TRUE(trajectory);
    const Verdict verdict =
        judge.judge({.version = 0,
                     .start_at = TimePoint{},
                     .candidates = {{StepId{JobId{0}}, *trajectory, Duration{}}},
                     .others = {},
                     .rest = rest,
                     .method = Swept{kTrackingError}});
    judged_free += verdict.kind == Verdict::Kind::free;
    if (answer.kind == LineChecker::Kind::free) {
      ++free;
      EXPECT_NE(verdict.kind, Verdict::Kind::conflict);
      for (int n = 0; n <= 300; ++n) {
        Eigen::VectorXd q = from + n / 300.0 * (to - from);
        for (double& x : q) {
          x += std::uniform_real_distribution(-kTrackingError, kTrackingError)(lines.random);
        }
        EXPECT_FALSE(too_close(q)) << n;
      }
      continue;
    }
    ASSERT_TRUE(answer.proximity);
    if (answer.kind == LineChecker::Kind::undecided) {
      ++undecided;
      continue;
    }
    ++conflicts;
    EXPECT_TRUE(too_close(from + answer.at * (to - from)));
    EXPECT_LT(answer.proximity->clearance_m, answer.proximity->limit_m);
  }
  EXPECT_GT(free, 40);
  EXPECT_GT(conflicts, 50);
  EXPECT_LE(undecided, 4) << "lines that pass something closely are rare";
  EXPECT_GE(free, judged_free - 4);
}

TEST(LineChecker, ChecksAStateWithItsTrackingError) {
  Lines lines(22);
  const ArmId left{0};
  const Configuration rest = lines.cell->home();
  LineChecker checker(lines.scene, left, rest, kTrackingError);
  EXPECT_EQ(checker.state(lines.cell->arm(left).home).kind, LineChecker::Kind::free);
  Eigen::VectorXd low = lines.cell->arm(left).home;
  low[1] = 1.7;  // into the table
  const auto answer = checker.state(low);
  EXPECT_EQ(answer.kind, LineChecker::Kind::conflict);
  EXPECT_LT(answer.proximity->clearance_m, lines.cell->clearances.clearance_m);
  LineChecker loose(lines.scene, left, rest, 3.0);
  EXPECT_NE(loose.state(lines.cell->arm(left).home).kind, LineChecker::Kind::free);
}

TEST(LineChecker, ChecksAttachedObjects) {
  Lines lines(23);
  const ArmId left{0};
  const LinkId hand = *lines.cell->find_link("left_panda_hand");
  Eigen::Isometry3d X_LO = Eigen::Isometry3d::Identity();
  X_LO.translation() = Eigen::Vector3d(0, 0, 0.4);
  const auto held = lines.scene->with_attachments(
      {Attachment{.object = {"rod", Cylinder{0.02, 0.5}, Eigen::Isometry3d::Identity()},
                  .link = hand,
                  .X_LO = X_LO}});
  ASSERT_TRUE(held) << held.error().front().detail;
  const Configuration rest = lines.cell->home();
  LineChecker bare(lines.scene, left, rest, kTrackingError);
  LineChecker holding(*held, left, rest, kTrackingError);
  int only_held = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::VectorXd from = lines.near_home(left, 0.3);
    const Eigen::VectorXd to = lines.near_home(left, 0.3);
    const bool is_free = holding.is_free(from, to);
    EXPECT_LE(is_free, bare.is_free(from, to)) << i;
    only_held += bare.is_free(from, to) && !is_free;
  }
  EXPECT_GT(only_held, 10);
}

}  // namespace
}  // namespace armloom
