// Spheres on crossing rails, whose smallest distance is known in closed form.
#include "core/coordination/in_step.h"

#include <gtest/gtest.h>

#include "core/collision/check/motion_checker.h"
#include "core/trajectory/stopping_reach.h"
#include "test/collision/small_cell.h"

namespace armloom::soundness {
namespace {

using namespace std::chrono_literals;

constexpr double kRadius_m = 0.05;
constexpr double kClearance_m = 0.02;
constexpr double kTracking_m = 0.001;
constexpr double kSpeed_m_s = 0.5;

void add_rail(Cell& cell, const std::string& name, const Eigen::Vector3d& along) {
  small::add_robot(cell, name, small::at_xyz(0, 0, 0), {along}, {0.0, kRadius_m});
  cell.joints.back().kind = cell.links.back().motion = JointKind::prismatic;
  cell.links.back().shapes.clear();
  small::add_shape(cell.links.back(), Sphere{kRadius_m}, small::at_xyz(0, 0, 0));
}

CellPtr two_rails() {
  Cell cell;
  cell.clearances.clearance_m = kClearance_m;
  add_rail(cell, "x", Eigen::Vector3d::UnitX());
  add_rail(cell, "y", Eigen::Vector3d::UnitY());
  return small::shared(std::move(cell));
}

// Returns a motion in which both arms cross at constant speed. The arm on y is `ahead_m` ahead.
TrajectoryPtr crossing(const Cell& cell, double ahead_m) {
  Segment segment{Duration{}, 4s, {}};
  segment.coefficients.setZero(2, 6);
  segment.coefficients.col(0) << -1.0, -1.0 + ahead_m;
  segment.coefficients.col(1).setConstant(kSpeed_m_s);
  const std::vector<JointId> joints{cell.arms[0].joints[0], cell.arms[1].joints[0]};
  return std::make_shared<const Trajectory>(joints, std::vector<ArmId>{ArmId{0}, ArmId{1}},
                                            std::vector<Segment>{segment});
}

TEST(InStep, ArmsKeepTheClearanceForAnyAllowedLag) {
  const CellPtr cell = two_rails();
  const double behind_s = to_seconds(lead_max(*cell, *crossing(*cell, 0.0))) +
                          stopping_reach_s(*cell, *crossing(*cell, 0.0));
  // Centers at (s, s + ahead) are at least |ahead| / sqrt(2) apart.
  const double least_m =
      std::sqrt(2.0) * (2.0 * kRadius_m + kClearance_m + 2.0 * kTracking_m) + kSpeed_m_s * behind_s;
  for (const double side : {1.0, -1.0}) {
    const auto kind_of = [&](double ahead_m) {
      const Motion both{StepId{JobId{1}}, crossing(*cell, side * ahead_m), {}};
      MotionChecker checker(PlanningScene::build(cell).value());
      return checker.judge({1, TimePoint{}, {both}, {}, cell->home(), Coordinated{kTracking_m}})
          .kind;
    };
    EXPECT_EQ(kind_of(least_m + 0.003), Verdict::Kind::free) << side;
    EXPECT_NE(kind_of(least_m - 0.006), Verdict::Kind::free) << side;
  }
}

}  // namespace
}  // namespace armloom::soundness
