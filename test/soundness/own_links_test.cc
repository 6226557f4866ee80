#include <gtest/gtest.h>

#include <random>

#include "core/collision/check/motion_checker.h"
#include "test/bench/states.h"
#include "test/collision/small_cell.h"
#include "test/soundness/concave_meshes.h"

// Joints that carry both links do not change the distance of the links. Joints between the links
// do.
namespace armloom::soundness {
namespace {

constexpr double kOff_rad = 0.05;
constexpr std::size_t kJoints = 4;

CellPtr folding_arm() {
  Cell cell;
  cell.clearances.clearance_m = 0.02;
  cell.clearances.self_clearance_m = 0.02;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  small::add_robot(cell, "arm", small::at_xyz(0, 0, 0), {up, up, Eigen::Vector3d::UnitY(), up},
                   {0.3, 0.03});
  return small::shared(std::move(cell));
}

TEST(OwnLinks, KeepTheirDistanceDespiteTrackingErrors) {
  const CellPtr cell = folding_arm();
  const PlanningScenePtr scene = PlanningScene::build(cell).value();
  MotionChecker checker(scene);
  bench::ExactScene exact(cell);
  std::mt19937_64 random(57);
  const std::vector<double> straight(kJoints, 0.0);
  const auto free_up_to = [&](const std::vector<double>& bent, double share) {
    std::vector<double> end;
    for (const double q : bent) end.push_back(share * q);
    const Motion motion{StepId{JobId{1}},
                        small::sweep(*cell, {ArmId{0}}, straight, end, std::chrono::seconds(2)),
                        {}};
    return checker.judge({1, TimePoint{}, {motion}, {}, cell->home(), Coordinated{kOff_rad}})
               .kind == Verdict::Kind::free;
  };
  int folded = 0;
  int near = 0;
  for (int i = 0; i < 60; ++i) {
    std::vector<double> bent;
    for (std::size_t j = 0; j < kJoints; ++j) bent.push_back(between(random, -3.0, 3.0));
    if (!free_up_to(bent, 0.0) || free_up_to(bent, 1.0)) continue;  // never too close, skip
    double most = 0.0;
    for (double from = 0.0, to = 1.0; to - from > 1e-3;) {
      const double middle = 0.5 * (from + to);
      (free_up_to(bent, middle) ? from : to) = middle;
      most = from;
    }
    ++folded;
    bool any_near = false;
    for (int k = 0; k < 300; ++k) {
      Configuration q = cell->home();
      Configuration past = q;
      for (std::size_t j = 0; j < kJoints; ++j) {
        const double off = k % 2 == 0 ? (random() % 2 == 0 ? -1.0 : 1.0) : between(random, -1, 1);
        const auto row = static_cast<Eigen::Index>(j);
        q[row] = most * bent[j] + 0.999 * kOff_rad * off;
        past[row] = most * bent[j] + 2.5 * kOff_rad * off;
      }
      ASSERT_FALSE(exact.self_too_close(q)) << "arm " << i << ", state " << k;
      any_near = any_near || exact.self_too_close(past);
    }
    near += any_near ? 1 : 0;
  }
  EXPECT_GE(folded, 10);
  EXPECT_GE(2 * near, folded);  // otherwise the bounds are too wide for this test
}

}  // namespace
}  // namespace armloom::soundness
