#include "core/monitor/path_distance.h"

#include <gtest/gtest.h>

#include "test/monitor/two_joint_arms.h"

namespace armloom {
namespace {

TEST(DistanceFromPath, FindsTheNearestCommonPoint) {
  const TrajectoryPtr curve = curve_of(ArmId{0});
  const std::vector<JointId> joints{JointId{0}, JointId{1}};
  for (const Duration at : std::vector<Duration>{3ms, 117ms, 1234567us, 1999ms}) {
    Eigen::VectorXd q;
    curve->sample_positions(at, q);
    const PathDistance far = distance_from_path(*curve, joints, 0ms, 2s, q, 0.0);
    EXPECT_LT(far.distance, 1e-4) << to_seconds(at);
    EXPECT_NEAR(to_seconds(far.progress), to_seconds(at), 1e-4);
  }
  Eigen::VectorXd q;
  curve->sample_positions(1s, q);
  q[0] += 0.01;
  q[1] -= 0.01;  // the velocity there is (1, 0): the distance is at least that of the second joint
  EXPECT_NEAR(distance_from_path(*curve, joints, 0ms, 2s, q, 0.0).distance, 0.01, 3e-4);
}

}  // namespace
}  // namespace armloom
