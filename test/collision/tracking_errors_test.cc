// Two spheres on crossing rails, whose robots promise different tracking errors.
#include <gtest/gtest.h>

#include "core/collision/check/line_checker.h"
#include "test/collision/rails.h"

namespace armloom {
namespace {

using namespace rails;

constexpr double kLoose_m = 0.03;
constexpr double kEdge_m = 1e-4;

// The robot of the arm along y is loose; the others keep the cell's error.
struct LooseRails : Rails {
  LooseRails() {
    Cell made = *cell;
    made.checking.tracking_error_rad = kTracking_m;
    made.robots[made.arm(kY).robot.index()].controller.tracking_error_rad = kLoose_m;
    cell = small::shared(std::move(made));
    checker.emplace(*PlanningScene::build(cell));
    question.method = Swept{TrackingErrors(*cell)};
  }
  // Judges a motion of `arm` along its rail, which an arm at rest is `apart_m` away from.
  Verdict::Kind passes(ArmId arm, ArmId resting, double apart_m) {
    question.candidates = {motion(1, {arm}, -1.0, 1.0)};
    question.rest[cell->arm(resting).joints[0].value()] = apart_m;
    return judge().kind;
  }
};

TEST(TrackingErrors, WidenMotionsAndRestsOfTheirRobotOnly) {
  for (const auto& [arm, resting] : {std::pair(kX, kY), std::pair(kY, kX)}) {
    LooseRails rails;
    const double least_m = kApart_m + kTracking_m + kLoose_m;
    EXPECT_EQ(rails.passes(arm, resting, least_m + kEdge_m), Verdict::Kind::free);
    EXPECT_NE(rails.passes(arm, resting, least_m - 0.01), Verdict::Kind::free);
  }
  LooseRails rails;  // neither of these is loose: the distance between their rails is 1 m
  rails.question.rest[rails.cell->arm(kY).joints[0].value()] = -1.9;
  EXPECT_EQ(rails.passes(kSecond, kX, 0.0), Verdict::Kind::free);
}

// Arms at rest that keep the clearance only without deviations may part, and may not come closer.
TEST(TrackingErrors, LetArmsPartThatOnlyJustKeepTheClearance) {
  Rails rails;
  const double gap_m = kApart_m + kTracking_m;
  rails.question.rest[1] = 0.0;
  const Motion away = rails.motion(1, {kX}, -gap_m, -1.0);
  const Motion across = rails.motion(1, {kX}, -gap_m, gap_m);
  const Motion closer = rails.motion(1, {kX}, -gap_m, -0.9 * kApart_m);
  rails.question.candidates = {away};
  EXPECT_TRUE(rails.judge().regions.empty());
  for (const Motion& motion : {across, closer}) {
    rails.question.candidates = {motion};
    EXPECT_FALSE(rails.judge().regions.empty());
  }
  rails.question.method = Swept{kTracking_m};
  for (const Motion& motion : {across, closer}) {
    rails.question.candidates = {motion};
    EXPECT_NE(rails.judge().kind, Verdict::Kind::free);
  }
  rails.question.candidates = {away};
  EXPECT_EQ(rails.judge().kind, Verdict::Kind::free);
}

TEST(TrackingErrors, AreInTheCertificatesByArm) {
  LooseRails rails;
  rails.question.candidates = {rails.motion(1, {kX, kY}, 0.5, 1.0)};
  const Verdict verdict = rails.judge();
  ASSERT_EQ(verdict.kind, Verdict::Kind::free);
  std::size_t sides = 0;
  for (const Certificate& certificate : verdict.certificates) {
    const auto* scene = std::get_if<SceneCertificate>(&certificate);
    if (scene == nullptr) continue;
    ++sides;
    EXPECT_EQ(scene->side.error_of(kX), kTracking_m);
    EXPECT_EQ(scene->side.error_of(kY), kLoose_m);
    EXPECT_EQ(scene->side.error_of(kSecond), 0.0) << "not an arm of this motion";
  }
  EXPECT_EQ(sides, 1U);
}

TEST(TrackingErrors, WidenPlannedLines) {
  LooseRails rails;
  const double least_m = kApart_m + kTracking_m + kLoose_m;
  for (const double off_m : {kEdge_m, -0.01}) {
    Configuration rest = rails.cell->home();
    rest[rails.cell->arm(kY).joints[0].value()] = least_m + off_m;
    LineChecker lines(*PlanningScene::build(rails.cell), kX, rest, TrackingErrors(*rails.cell));
    const Eigen::VectorXd from = Eigen::VectorXd::Constant(1, -1.0);
    EXPECT_EQ(lines.is_free(from, -from), off_m > 0.0) << off_m;
  }
}

}  // namespace
}  // namespace armloom
