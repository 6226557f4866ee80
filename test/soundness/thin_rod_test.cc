#include <gtest/gtest.h>

#include "core/collision/check/motion_checker.h"
#include "test/collision/small_cell.h"

// Defect T4: two thin rods cross quickly between the samples of the discrete check.
namespace armloom::soundness {
namespace {

using namespace std::chrono_literals;

CellPtr two_rods() {
  Cell cell;
  cell.clearances.clearance_m = 0.001;
  cell.clearances.self_clearance_m = 0.0;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  small::add_robot(cell, "left", small::at_xyz(0, 0, 0), {up}, {0.5, 0.003});
  small::add_robot(cell, "right", small::at_xyz(0.9, 0, 0), {up}, {0.5, 0.003});
  return small::shared(std::move(cell));
}

// The left rod swings past +x. The right rod rests and points at the left rod. The left rod passes
// the middle `offset` later than a multiple of every discrete step.
Question crossing(const Cell& cell, Duration offset, const CheckMethod& method) {
  const double half = small::kHalfTurn;
  const Motion left{
      StepId{JobId{1}}, small::sweep(cell, {ArmId{0}}, {-1.2}, {1.2}, 400ms + 2 * offset), {}};
  const Motion right{StepId{JobId{2}}, small::sweep(cell, {ArmId{1}}, {half}, {half}, 1s), {}};
  return {1, TimePoint{}, {left}, {right}, cell.home(), method};
}

TEST(ThinRod, CrossingBetweenSamplesIsFoundOnlyByCertifiedChecks) {
  const CellPtr cell = two_rods();
  MotionChecker checker(PlanningScene::build(cell).value());
  const Duration offset = 22ms;
  for (const Duration step : {100ms, 50ms}) {
    EXPECT_EQ(checker.judge(crossing(*cell, offset, TimedDiscrete{step})).kind,
              Verdict::Kind::free);
  }
  const Verdict verdict = checker.judge(crossing(*cell, offset, Coordinated{0.0}));
  ASSERT_EQ(verdict.kind, Verdict::Kind::free);
  ASSERT_EQ(verdict.regions.size(), 1U);
  ASSERT_EQ(verdict.regions[0].regions.size(), 1U);
  const ConflictRegion& region = verdict.regions[0].regions[0];
  EXPECT_LT(region.proximity.clearance_m, cell->clearances.clearance_m);
  EXPECT_LE(region.boxes.front().from_a, 222ms);
  EXPECT_GE(region.boxes.back().to_a, 222ms);
  EXPECT_EQ(checker.judge(crossing(*cell, offset, Swept{0.0})).kind, Verdict::Kind::conflict);
}

}  // namespace
}  // namespace armloom::soundness
