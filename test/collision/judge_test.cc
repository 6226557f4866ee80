#include <gtest/gtest.h>

#include "test/collision/row_of_arms.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using namespace row_of_arms;
using With = Conflict::With;

TEST(DiscreteCheck, ChecksEveryStepAndTheEnd) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(1, kA, kUp, kPi, 1010ms)};
  const Verdict verdict = judged();
  EXPECT_EQ(verdict.kind, Verdict::Kind::free);
  EXPECT_EQ(verdict.version, 42U);
  EXPECT_TRUE(verdict.conflicts.empty());
  EXPECT_FALSE(verdict.clearance_bound.has_value());
  EXPECT_EQ(verdict.evaluations, 22U);  // 0, 50, ..., 1000 and 1010 ms
}

// Defect T2: only the remaining half of b's motion may be checked.
TEST(DiscreteCheck, ChecksAgainstTheRemainingPartOfAMotion) {
  Judged judged(row());
  // b leaves a's side within its first half.
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 4s)};
  judged.question.others = {judged.begun(judged.motion(1, kB, kPi, 0, 4s), 2s)};
  EXPECT_EQ(judged().kind, Verdict::Kind::free);

  // b reaches a's side in the second half of its motion. A check that used a's clock for both
  // motions would look at the first half.
  judged.question.others = {judged.begun(judged.motion(1, kB, 0, kPi, 4s), 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.kind, Verdict::Kind::conflict);
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  const Conflict& conflict = verdict.conflicts[0];
  EXPECT_EQ(conflict.with, With::motion);
  EXPECT_EQ(conflict.candidate, StepId{JobId{2}});
  EXPECT_EQ(conflict.other_step, StepId{JobId{1}});
  EXPECT_EQ(conflict.proximity.body_a, "a_link1");
  EXPECT_EQ(conflict.proximity.body_b, "b_link1");
  EXPECT_EQ(conflict.other_time, std::min<Duration>(conflict.own_time + 2s, 4s));
  EXPECT_GT(conflict.own_time, 1s);
  EXPECT_LT(conflict.proximity.clearance_m, 0.02);
}

// Defect T3: the other arm's rest must be checked before and after its motion.
TEST(DiscreteCheck, FindsAConflictWithAnArmAtRestAfterItsShorterMotion) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(2, kA, kPi, 0, 8s)};
  judged.question.others = {judged.motion(1, kB, kUp, kPi, 1s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, With::motion);
  EXPECT_EQ(verdict.conflicts[0].other_time, 1s);  // at its goal
  EXPECT_GT(verdict.conflicts[0].own_time, 4s);
}

TEST(DiscreteCheck, FindsALongerMotionThatHitsTheCandidateAtRest) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 1s)};
  judged.question.others = {judged.motion(1, kB, 0, kPi, 8s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].own_time, 1s);
  EXPECT_GT(verdict.conflicts[0].other_time, 4s);
}

TEST(DiscreteCheck, FindsAConflictWithAnArmAtRestBeforeItsLaterMotion) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 2s)};
  judged.question.others = {judged.begun(judged.motion(1, kB, kPi, 0, 2s), -10s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].other_time, 0s);
  judged.question.others = {judged.begun(judged.motion(1, kB, kPi, 0, 2s), 0s)};
  judged.question.candidates = {judged.begun(judged.motion(2, kA, kUp, 0, 2s), -2s)};
  EXPECT_EQ(judged().kind, Verdict::Kind::free);
}

// Defect T4.
TEST(DiscreteCheck, FindsAThinRodOnlyWithFineSteps) {
  Cell cell = row();
  cell.clearances.clearance_m = 0.001;
  cell.links[1].shapes = small::capsule_along_x(0.0, 0.4, 0.005);
  cell.objects.push_back(
      {"rod", Cylinder{0.004, 0.5}, small::at_xyz(0.3 * std::cos(0.7), 0.3 * std::sin(0.7), 0)});
  Judged judged(cell);
  judged.question.candidates = {judged.motion(1, kA, kUp, 0, 1s)};
  judged.question.method = TimedDiscrete{100ms};
  EXPECT_EQ(judged().kind, Verdict::Kind::free);
  judged.question.method = TimedDiscrete{5ms};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, With::scene);
  EXPECT_EQ(verdict.conflicts[0].proximity.body_b, "rod");
  EXPECT_TRUE(verdict.conflicts[0].proximity.object_b);
}

TEST(DiscreteCheck, ChecksTheGoalEvenIfTheStepIsLongerThanTheMotion) {
  Judged judged(row());
  judged.question.rest[1] = kPi;
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 1s)};
  judged.question.method = TimedDiscrete{30s};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].own_time, 1s);
  EXPECT_EQ(verdict.evaluations, 2U);
}

TEST(DiscreteCheck, LetsAPairThatIsTooCloseMoveApart) {
  Judged judged(row());
  judged.question.rest[1] = kPi;
  judged.question.candidates = {judged.motion(2, kA, 0, kUp, 2s)};  // out of an overlap
  EXPECT_EQ(judged().kind, Verdict::Kind::free);
}

TEST(DiscreteCheck, RejectsAPairThatIsTooCloseAndComesCloser) {
  Judged judged(row());
  judged.question.rest[1] = kPi;
  // The links are closest at 0 rad, where they are parallel. At 0.12 rad their distance falls below
  // the clearance.
  judged.question.candidates = {judged.motion(2, kA, 0.12, -0.12, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_GT(verdict.conflicts[0].own_time, 0s);
}

TEST(DiscreteCheck, RejectsAReturnAfterAPairHasMovedApart) {
  Judged judged(row());
  judged.question.rest[1] = kPi;
  auto there = small::sweep(*judged.cell, {kA}, {0.0}, {kUp}, 2s)->segments();
  auto back = small::sweep(*judged.cell, {kA}, {kUp}, {0.0}, 2s)->segments();
  back[0].start = 2s;
  there.push_back(back[0]);
  const auto joints = judged.cell->arm(kA).joints;
  judged.question.candidates = {
      {StepId{JobId{2}}, std::make_shared<const Trajectory>(joints, std::vector{kA}, there), 0s}};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_GT(verdict.conflicts[0].own_time, 3s);
}

TEST(DiscreteCheck, AnswersRepeatedQuestionsEqually) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(2, kA, kPi, 0, 8s)};
  judged.question.others = {judged.motion(1, kB, kUp, kPi, 1s)};
  const Verdict first = judged();
  (void)judged.checker.first_closer_than(Configuration::Constant(3, 0.3), 0.02, {true, true, true});
  const Verdict second = judged();
  ASSERT_EQ(first.conflicts.size(), second.conflicts.size());
  EXPECT_EQ(first.evaluations, second.evaluations);
  EXPECT_EQ(first.conflicts[0].own_time, second.conflicts[0].own_time);
  EXPECT_EQ(first.conflicts[0].proximity.clearance_m, second.conflicts[0].proximity.clearance_m);
}

TEST(DiscreteCheck, ThrowsOnInvalidQuestions) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 1s)};
  judged.question.others = {judged.motion(1, kA, kUp, 0, 1s)};
  EXPECT_THROW((void)judged(), std::invalid_argument);
  judged.question.others.clear();
  judged.question.method = TimedDiscrete{0s};
  EXPECT_THROW((void)judged(), std::invalid_argument);
}

}  // namespace
}  // namespace armloom
