#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/collision/check/pair_regions.h"
#include "test/collision/rails.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using namespace rails;

bool hold(const std::vector<ConflictRegion>& regions, Duration a, Duration b) {
  return std::ranges::any_of(regions, [&](const ConflictRegion& region) {
    return std::ranges::any_of(region.boxes, [&](const ProgressBox& box) {
      return box.from_a <= a && a <= box.to_a && box.from_b <= b && b <= box.to_b;
    });
  });
}

ProgressBox around(const ConflictRegion& region) {
  ProgressBox hull = region.boxes.front();
  for (const ProgressBox& box : region.boxes) {
    hull = {std::min(hull.from_a, box.from_a), std::max(hull.to_a, box.to_a),
            std::min(hull.from_b, box.from_b), std::max(hull.to_b, box.to_b)};
  }
  return hull;
}

// Returns how far (m) from the true conflict an uncertified state may lie. A fine cell is
// uncertified if its middle is so close to the conflict that both arms reach it within half of the
// cell. The cell's farthest state is as far away again. A coarse cell is uncertified if its middle
// is in conflict; then its farthest state is half a cell away.
double slack_m() {
  const auto moves = [](Duration width) {
    return 2 * (kSpeed_m_s * to_seconds(width) / 2 + kTracking_m);
  };
  return std::max(2 * moves(PairRegionSearch::kResolution.fine),
                  moves(PairRegionSearch::kResolution.coarse)) +
         1e-4;
}

// Returns the distance of the centers at x = -1 + v a, y = `start` + v b.
double apart_m(Duration a, Duration b, double start) {
  return std::hypot(-1.0 + kSpeed_m_s * to_seconds(a), start + kSpeed_m_s * to_seconds(b));
}

TEST(CoordinatedCheck, RegionEnclosesTheCrossingDiskTightly) {
  for (const bool turned : {false, true}) {
    Rails rails;
    rails.question.candidates = {rails.motion(1, {kX}, -1, 1)};
    rails.question.others = {rails.motion(2, {kY}, -1.2, 1.2)};
    if (turned) std::swap(rails.question.candidates, rails.question.others);
    const Verdict verdict = rails.judge();
    ASSERT_EQ(verdict.kind, Verdict::Kind::free);
    EXPECT_EQ(verdict.clearance_bound.value().apart_m, kClearance_m);
    EXPECT_TRUE(verdict.conflicts.empty());
    ASSERT_EQ(verdict.regions.size(), 1U);
    const PairRegions& pair = verdict.regions[0];
    EXPECT_EQ(pair.a, StepId{JobId{turned ? 2U : 1U}});
    EXPECT_EQ(std::get<StepId>(pair.b), StepId{JobId{turned ? 1U : 2U}});
    ASSERT_EQ(pair.regions.size(), 1U);
    EXPECT_LE(pair.regions[0].boxes.size(), 40U);
    const Proximity& proximity = pair.regions[0].proximity;
    EXPECT_EQ(proximity.body_a, turned ? "y_link1" : "x_link1");
    EXPECT_EQ(proximity.body_b, turned ? "x_link1" : "y_link1");
    EXPECT_LT(proximity.clearance_m, kClearance_m);
    Duration at_x = pair.regions[0].time_a;
    Duration at_y = pair.regions[0].time_b;
    if (turned) std::swap(at_x, at_y);
    EXPECT_NEAR(proximity.clearance_m, apart_m(at_x, at_y, -1.2) - 2 * kRadius_m, 1e-5);
    for (Duration a{}; a <= 4s; a += 7ms) {
      for (Duration b{}; b <= 4800ms; b += 7ms) {
        const double distance_m = apart_m(a, b, -1.2);
        const bool held = turned ? hold(pair.regions, b, a) : hold(pair.regions, a, b);
        if (distance_m < kApart_m + 2 * kTracking_m - 1e-6) {
          ASSERT_TRUE(held) << to_seconds(a) << " " << to_seconds(b);
        } else if (distance_m > kApart_m + slack_m()) {
          ASSERT_FALSE(held) << to_seconds(a) << " " << to_seconds(b);
        }
      }
    }
  }
}

TEST(CoordinatedCheck, RegionReachesTheEndOfAMotionThatEndsInTheWay) {
  Rails rails;
  rails.question.candidates = {rails.motion(1, {kX}, -1, 1)};
  rails.question.others = {rails.motion(2, {kY}, -1.1, 0)};
  Verdict verdict = rails.judge();
  ASSERT_EQ(verdict.regions.size(), 1U);
  ASSERT_EQ(verdict.regions[0].regions.size(), 1U);
  EXPECT_EQ(around(verdict.regions[0].regions[0]).to_b, 2200ms);
  EXPECT_GT(around(verdict.regions[0].regions[0]).from_b, 0s);

  rails.question.others = {rails.motion(3, {kY}, 0, 1.1)};
  verdict = rails.judge();
  ASSERT_EQ(verdict.regions.size(), 1U);
  EXPECT_EQ(around(verdict.regions[0].regions[0]).from_b, 0s);
  EXPECT_LT(around(verdict.regions[0].regions[0]).to_b, 2200ms);
}

TEST(CoordinatedCheck, RegionWithAnArmAtRestHasNoTimesForThatArm) {
  Rails rails;
  rails.question.rest[1] = 0.0;  // y rests in the middle of x's path
  rails.question.candidates = {rails.motion(1, {kX}, -1, 1)};
  const Verdict verdict = rails.judge();
  ASSERT_EQ(verdict.kind, Verdict::Kind::free);
  ASSERT_EQ(verdict.regions.size(), 1U);
  EXPECT_EQ(std::get<ArmId>(verdict.regions[0].b), kY);
  ASSERT_EQ(verdict.regions[0].regions.size(), 1U);
  const ConflictRegion& region = verdict.regions[0].regions[0];
  ASSERT_EQ(region.boxes.size(), 1U);
  EXPECT_EQ(region.boxes[0].from_b, 0s);
  EXPECT_EQ(region.boxes[0].to_b, 0s);
  EXPECT_EQ(region.time_b, 0s);
  const double half_s = (kApart_m + 2 * kTracking_m) / kSpeed_m_s;
  EXPECT_LE(to_seconds(region.boxes[0].from_a), 2.0 - half_s + 1e-6);
  EXPECT_GE(to_seconds(region.boxes[0].to_a), 2.0 + half_s - 1e-6);
  const double slack_s = (kApart_m + slack_m()) / kSpeed_m_s;
  EXPECT_GE(to_seconds(region.boxes[0].from_a), 2.0 - slack_s);
  EXPECT_LE(to_seconds(region.boxes[0].to_a), 2.0 + slack_s);
}

TEST(CoordinatedCheck, ChecksOnlyTheRemainingMotion) {
  Rails rails;
  rails.question.candidates = {rails.motion(1, {kX}, -1, 1)};
  rails.question.others = {rails.motion(2, {kY}, -1, 1)};
  rails.question.others[0].progress = 2500ms;  // past the crossing
  EXPECT_TRUE(rails.judge().regions.empty());
  rails.question.others[0].progress = 1000ms;
  EXPECT_EQ(rails.judge().regions.size(), 1U);
}

TEST(CoordinatedCheck, RepeatedQuestionNeedsNoNewEvaluations) {
  Rails rails;
  rails.question.candidates = {rails.motion(1, {kX}, -1, 1)};
  rails.question.others = {rails.motion(2, {kY}, -1, 1)};
  const Verdict first = rails.judge();
  rails.question.others[0].progress = 100ms;
  const Verdict second = rails.judge();
  EXPECT_GT(first.evaluations, 100U);
  EXPECT_EQ(second.evaluations, 0U);
  ASSERT_EQ(second.regions.size(), 1U);
  EXPECT_EQ(second.regions[0].regions[0].boxes.size(), first.regions[0].regions[0].boxes.size());
}

TEST(CoordinatedCheck, NeedsFewCellsIfArmsStayApart) {
  Rails rails;
  rails.question.candidates = {rails.motion(1, {kX}, 0.5, 1.5)};
  rails.question.others = {rails.motion(2, {kY}, -1.5, 0.5)};
  const Verdict verdict = rails.judge();
  EXPECT_TRUE(verdict.regions.empty());
  EXPECT_LE(verdict.evaluations, 80U);
}

TEST(CoordinatedCheck, ComparesMotionsOfDifferentArmsOnly) {
  Rails rails;
  rails.question.others = {rails.motion(11, {kY}, -1, 1),
                           rails.to_come(rails.motion(12, {kY}, 1, -1)),
                           rails.motion(13, {kX}, 1, -1)};
  rails.question.candidates = {rails.to_come(rails.motion(1, {kX}, -1, 1)),
                               rails.to_come(rails.motion(2, {kX}, 1, -1)),
                               rails.to_come(rails.motion(3, {kY}, -1, 1))};
  const Verdict verdict = rails.judge();
  ASSERT_EQ(verdict.kind, Verdict::Kind::free);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> pairs;
  for (const PairRegions& pair : verdict.regions) {
    EXPECT_EQ(pair.regions.size(), 1U);
    pairs.emplace_back(pair.a.job.value(), std::get<StepId>(pair.b).job.value());
  }
  const std::vector<std::pair<std::uint64_t, std::uint64_t>> expected{
      {1, 11}, {1, 12}, {1, 3}, {2, 11}, {2, 12}, {2, 3}, {3, 13}};
  EXPECT_EQ(pairs, expected);
}

TEST(CoordinatedCheck, JoinsTheArmsOfASynchronousMotion) {
  Rails rails;
  // y passes the rails of the two arms at 2 s and at 4 s. Both arms are at those places at 2 s.
  rails.question.candidates = {rails.motion(1, {kX, kSecond}, -1, 1)};
  rails.question.others = {rails.motion(2, {kY}, -1, 1.7)};
  Verdict verdict = rails.judge();
  ASSERT_EQ(verdict.kind, Verdict::Kind::free);
  ASSERT_EQ(verdict.regions.size(), 1U);
  ASSERT_EQ(verdict.regions[0].regions.size(), 2U);
  EXPECT_TRUE(hold(verdict.regions[0].regions, 2s, 2s));
  EXPECT_TRUE(hold(verdict.regions[0].regions, 2s, 4s));
  EXPECT_FALSE(hold(verdict.regions[0].regions, 2s, 3s));
  rails.question.others.clear();
  rails.question.rest[1] = 1.0;
  verdict = rails.judge();
  ASSERT_EQ(verdict.regions.size(), 1U);
  EXPECT_EQ(verdict.regions[0].regions.size(), 1U);
  EXPECT_EQ(verdict.regions[0].regions[0].proximity.arm_a, kSecond);
}

TEST(CoordinatedCheck, ReportsAConflictOfACandidateWithTheScene) {
  Rails rails;
  rails.question.candidates = {rails.motion(1, {kX}, -1.685, 1)};  // starts too close to the post
  rails.question.others = {rails.motion(2, {kY}, -1, 1)};
  Verdict verdict = rails.judge();
  EXPECT_EQ(verdict.kind, Verdict::Kind::free) << "it moves away";
  rails.question.candidates = {rails.motion(1, {kX}, 1, -1.8)};
  verdict = rails.judge();
  ASSERT_EQ(verdict.kind, Verdict::Kind::conflict);
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, Conflict::With::scene);
  EXPECT_TRUE(verdict.regions.empty());
  EXPECT_FALSE(verdict.clearance_bound);
}

TEST(CoordinatedCheck, ReportsASynchronousMotionWhoseArmsMeet) {
  Rails rails;
  rails.question.candidates = {rails.motion(1, {kX, kY}, -1, 1)};
  const Verdict verdict = rails.judge();
  ASSERT_EQ(verdict.kind, Verdict::Kind::conflict);
  EXPECT_EQ(verdict.conflicts[0].with, Conflict::With::self);
}

TEST(CoordinatedCheck, AllowsAPairThatIsTooCloseToMoveApart) {
  Rails rails;
  rails.question.rest[1] = 0.0;
  rails.question.candidates = {rails.motion(1, {kX}, 0.115, 1)};  // away from y, too close
  EXPECT_TRUE(rails.judge().regions.empty());
  rails.question.candidates = {rails.motion(2, {kX}, 0.115, -1)};  // through it
  EXPECT_EQ(rails.judge().regions.size(), 1U);
  // A later motion must not start too close.
  rails.question.candidates = {rails.to_come(rails.motion(3, {kX}, 0.115, 1))};
  const Verdict verdict = rails.judge();
  ASSERT_EQ(verdict.regions.size(), 1U);
  EXPECT_EQ(verdict.regions[0].regions[0].boxes[0].from_a, 0s);
}

// x and y move together. Then x alone returns to where y still rests.
TEST(CoordinatedCheck, ChecksAgainstTheOtherArmsOfASharedMotion) {
  Rails rails;
  rails.question.others = {rails.motion(1, {kX, kY}, 1.5, 0.1)};
  rails.question.others[0].progress = 2799ms;
  rails.question.candidates = {rails.to_come(rails.motion(2, {kX}, 0.1, -1))};
  Verdict verdict = rails.judge();
  ASSERT_EQ(verdict.regions.size(), 1U);
  EXPECT_EQ(std::get<ArmId>(verdict.regions[0].b), kY);
  rails.question.others.push_back(rails.to_come(rails.motion(3, {kY}, 0.1, 1.5)));
  verdict = rails.judge();
  ASSERT_EQ(verdict.regions.size(), 1U);
  EXPECT_EQ(std::get<StepId>(verdict.regions[0].b), StepId{JobId{3}});
  EXPECT_EQ(around(verdict.regions[0].regions[0]).from_b, 0s);
}

// After x has passed, a second motion moves both arms. Until then y rests 7 mm away from where that
// motion starts.
TEST(CoordinatedCheck, UsesTheArmsPositionNotItsMotionsStart) {
  Rails rails;
  rails.question.candidates = {rails.motion(1, {kX}, -1, 0.125),
                               rails.to_come(rails.motion(2, {kX, kY}, 0.125, 1.5))};
  rails.question.rest[1] = 0.118;
  const Verdict verdict = rails.judge();
  ASSERT_EQ(verdict.regions.size(), 1U);
  EXPECT_EQ(std::get<ArmId>(verdict.regions[0].b), kY);
  rails.question.rest[1] = 0.125;
  EXPECT_TRUE(rails.judge().regions.empty());
}

// Two motions of 20 minutes with hundreds of thousands of crossings.
void cross_for_long(Rails& rails) {
  rails.question.candidates = {rails.shuttle(1, kX, -0.3, 0.3, 1000)};
  rails.question.others = {rails.shuttle(2, kY, -0.31, 0.3, 1000)};
}

TEST(CoordinatedCheck, LongMotionsStayWithinTheCellLimit) {
  Rails rails;
  cross_for_long(rails);
  for (const std::uint64_t effort : {1U, 4U}) {
    rails.question.effort = effort;
    const Verdict verdict = rails.judge();
    EXPECT_EQ(verdict.kind, Verdict::Kind::free);
    EXPECT_FALSE(verdict.regions.empty());
    EXPECT_FALSE(verdict.exhausted) << "a larger effort would find no more";
    // 50,000 more are allowed for isolated cells, whose number grows with the length of the
    // motions.
    EXPECT_LT(verdict.evaluations, 2 * PairRegionSearch::kCellsMax + 50'000);
  }
}

TEST(CoordinatedCheck, InterruptedCheckReportsItAndLeavesNoState) {
  Rails rails;
  rails.question.candidates = {rails.motion(1, {kX}, -1, 1)};
  rails.question.others = {rails.motion(2, {kY}, -1.2, 1.2)};
  const std::uint64_t evaluations = rails.judge().evaluations;
  cross_for_long(rails);
  CheckProgress progress;
  progress.interrupt();
  const Verdict verdict = rails.checker->judge(rails.question, &progress);
  EXPECT_TRUE(verdict.interrupted);
  EXPECT_EQ(verdict.kind, Verdict::Kind::undecided);
  EXPECT_GT(progress.share(), 0.0);
  EXPECT_LT(progress.share(), 0.01);
  rails.question.candidates = {rails.motion(1, {kX}, -1, 1)};
  rails.question.others = {rails.motion(2, {kY}, -1.2, 1.2)};
  EXPECT_EQ(rails.judge().evaluations, evaluations);
}

}  // namespace
}  // namespace armloom
