#include "core/trajectory/joint_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "core/trajectory/validate.h"
#include "test/trajectory/random_spline.h"
#include "test/trajectory/test_cell.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using testing::random_spline;
using testing::SplineScale;
using testing::uniform;

Cell strict_cell() {
  Cell cell = testing::test_cell();
  cell.checking.limit_tolerance = 0.0;
  return cell;
}

Eigen::VectorXd random_place(std::mt19937_64& random, const Cell& cell,
                             const std::vector<JointId>& joints) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = cell.joint(joints[j]);
    q[static_cast<Eigen::Index>(j)] = uniform(random, joint.lower, joint.upper);
  }
  return q;
}

// Returns the largest share of any limit that the line uses. Jerk is computed by differences.
double share_of(const Cell& cell, const Trajectory& line) {
  double share = 0.0;
  const Duration step = line.duration() / 4000;
  JointState state, next;
  for (Duration t{}; t + step < line.duration(); t += step) {
    line.sample(t, state);
    line.sample(t + step, next);
    for (Eigen::Index j = 0; j < state.position.size(); ++j) {
      const Joint& joint = cell.joint(line.joints()[static_cast<std::size_t>(j)]);
      const double jerk = (next.acceleration[j] - state.acceleration[j]) / to_seconds(step);
      share = std::max({share, std::abs(state.velocity[j]) / joint.velocity_max,
                        std::abs(state.acceleration[j]) / joint.acceleration_max,
                        std::abs(jerk) / joint.jerk_max});
    }
  }
  return share;
}

TEST(JointLine, DurationScalesWithTheCellsVelocityFactor) {
  Cell cell = strict_cell();
  const auto& joints = cell.arms[0].joints;
  std::mt19937_64 random(5);
  const Eigen::VectorXd from = random_place(random, cell, joints);
  const Eigen::VectorXd to = random_place(random, cell, joints);
  const Duration fast = (*joint_line(cell, joints, from, to))->duration();
  cell.execution.velocity_scaling_factor = 0.25;
  const Duration slow = (*joint_line(cell, joints, from, to))->duration();
  EXPECT_NEAR(to_seconds(slow), 4 * to_seconds(fast), 1e-6);
}

TEST(JointLine, KeepsAllLimitsAndUsesOneFully) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Cell cell = strict_cell();
    const std::vector<JointId> joints = cell.arm(ArmId(0)).joints;
    for (const JointId joint : joints) {
      Joint& j = cell.joints[joint.index()];
      j.acceleration_max = uniform(random, 0.5, 20.0);
      j.jerk_max = std::pow(10.0, uniform(random, 0.5, 4.0));
    }
    const auto from = random_place(random, cell, joints), to = random_place(random, cell, joints);
    const auto line = joint_line(cell, joints, from, to);
    ASSERT_TRUE(line) << line.error().front().detail;
    const double share = share_of(cell, **line);
    EXPECT_LE(share, 1.0 + 1e-6);
    EXPECT_GE(share, 0.99) << "some limit is used up";
  }
}

TEST(JointLine, IsStraightAndExactlyAtRestAtBothEnds) {
  std::mt19937_64 random(12);
  const Cell cell = strict_cell();
  const std::vector<JointId> joints = cell.arm(ArmId(1)).joints;
  for (int i = 0; i < 50; ++i) {
    SCOPED_TRACE(i);
    const auto from = random_place(random, cell, joints), to = random_place(random, cell, joints);
    const TrajectoryPtr line = joint_line(cell, joints, from, to).value();
    EXPECT_EQ(line->arms(), std::vector<ArmId>{ArmId(1)});
    EXPECT_EQ(line->start(), from);
    EXPECT_LT((line->goal() - to).cwiseAbs().maxCoeff(), 1e-12);
    JointState state;
    line->sample(line->duration() - 1ns, state);
    EXPECT_LT(state.velocity.cwiseAbs().maxCoeff(), 1e-6);
    for (const double x : {0.1, 0.37, 0.5, 0.9}) {
      line->sample(from_seconds(x * to_seconds(line->duration())), state);
      const Eigen::VectorXd along = (state.position - from).cwiseQuotient(to - from);
      EXPECT_NEAR(along.minCoeff(), along.maxCoeff(), 1e-9);
      EXPECT_NEAR(along[0], x * x * x * (10 - 15 * x + 6 * x * x), 1e-6);
    }
  }
}

TEST(JointLine, ToItsOwnStartIsAShortRest) {
  const Cell cell = strict_cell();
  const std::vector<JointId> joints = cell.arm(ArmId(2)).joints;
  const Eigen::VectorXd here = Eigen::Vector2d(0.3, -0.4);
  const TrajectoryPtr line = joint_line(cell, joints, here, here).value();
  EXPECT_EQ(line->duration(), kLineMin);
  EXPECT_EQ(line->goal(), here);
}

TEST(JointLine, IsValidatedLikeEveryTrajectory) {
  const Cell cell = strict_cell();
  const std::vector<JointId> joints = cell.arm(ArmId(2)).joints;
  const auto outside = joint_line(cell, joints, Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 3));
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().front().slug, "position-limit");
  const auto part = joint_line(cell, {joints[0]}, Eigen::VectorXd::Zero(1), Eigen::VectorXd(1));
  ASSERT_FALSE(part);
  EXPECT_EQ(part.error().front().slug, "missing-joint");
  EXPECT_THROW((void)joint_line(cell, joints, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(2)),
               std::invalid_argument);
}

TrajectoryPtr valid_spline(std::mt19937_64& random, const Cell& cell, bool quintic) {
  const SplineScale slow{.reach = 0.3, .shortest_s = 1.0, .longest_s = 2.0};
  return validate(random_spline(random, slow, quintic), cell).value();
}

TEST(Retraced, MirrorsTimeAndNegatesVelocity) {
  std::mt19937_64 random(13);
  const Cell cell = strict_cell();
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const TrajectoryPtr there = valid_spline(random, cell, i % 2 == 1);
    const TrajectoryPtr back = retraced(*there);
    ASSERT_EQ(back->duration(), there->duration());
    EXPECT_EQ(back->joints(), there->joints());
    EXPECT_EQ(back->start(), there->goal());
    EXPECT_LT((back->goal() - there->start()).cwiseAbs().maxCoeff(), 1e-12);
    JointState a, b;
    for (int k = 1; k < 200; ++k) {
      const Duration t = there->duration() * k / 200;
      there->sample(t, a);
      back->sample(there->duration() - t, b);
      EXPECT_LT((a.position - b.position).cwiseAbs().maxCoeff(), 1e-11);
      EXPECT_LT((a.velocity + b.velocity).cwiseAbs().maxCoeff(), 1e-10);
      EXPECT_LT((a.acceleration - b.acceleration).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
}

TEST(Retraced, TwiceIsTheOriginalMotion) {
  std::mt19937_64 random(14);
  const Cell cell = strict_cell();
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const TrajectoryPtr once = valid_spline(random, cell, i % 2 == 1);
    const TrajectoryPtr twice = retraced(*retraced(*once));
    ASSERT_EQ(twice->segments().size(), once->segments().size());
    JointState a, b;
    for (int k = 0; k < 200; ++k) {
      const Duration t = once->duration() * k / 200;
      once->sample(t, a);
      twice->sample(t, b);
      EXPECT_LT((a.position - b.position).cwiseAbs().maxCoeff(), 1e-11);
      EXPECT_LT((a.velocity - b.velocity).cwiseAbs().maxCoeff(), 1e-10);
    }
    for (std::size_t s = 0; s < once->segments().size(); ++s) {
      EXPECT_EQ(twice->segments()[s].start, once->segments()[s].start);
    }
  }
}

// Checks the reversed motion again with validate().
TEST(Retraced, KeepsEveryLimitOfTheCell) {
  std::mt19937_64 random(15);
  const Cell cell = strict_cell();
  const std::vector<JointId> joints = cell.arm(ArmId(2)).joints;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const auto from = random_place(random, cell, joints), to = random_place(random, cell, joints);
    const TrajectoryPtr back = retraced(*joint_line(cell, joints, from, to).value());
    EXPECT_LE(share_of(cell, *back), 1.0 + 1e-6);
    TrajectoryRequest request{{"pair_a", "pair_b"}, {}};
    for (const double x : {0.0, 0.3, 0.6, 1.0}) {
      const Duration t = from_seconds(x * to_seconds(back->duration()));
      JointState state;
      back->sample(t, state);
      request.points.push_back({{state.position.begin(), state.position.end()},
                                {state.velocity.begin(), state.velocity.end()},
                                {state.acceleration.begin(), state.acceleration.end()},
                                to_seconds(t)});
    }
    const auto checked = validate(request, cell);
    EXPECT_TRUE(checked) << checked.error().front().detail;
  }
}

}  // namespace
}  // namespace armloom
