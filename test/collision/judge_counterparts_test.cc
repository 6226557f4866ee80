#include <gtest/gtest.h>

#include "test/collision/row_of_arms.h"

namespace armloom {
namespace {

using namespace row_of_arms;
using With = Conflict::With;

TEST(DiscreteCheck, ReportsAnArmAtRestThatNoJobWillMove) {
  Judged judged(row());
  judged.question.rest[1] = kPi;
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, With::rest);
  EXPECT_EQ(verdict.conflicts[0].proximity.arm_b, kB);
  EXPECT_FALSE(verdict.conflicts[0].other_step.has_value());
}

TEST(DiscreteCheck, PutsTheCandidateFirstInTheEvidence) {
  Judged judged(row());
  judged.question.rest[0] = 0;
  judged.question.candidates = {judged.motion(2, kB, kUp, kPi, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].proximity.body_a, "b_link1");
  EXPECT_EQ(verdict.conflicts[0].proximity.arm_a, kB);
  EXPECT_EQ(verdict.conflicts[0].proximity.body_b, "a_link1");
}

TEST(DiscreteCheck, ReportsEveryCounterpartAtTheFirstConflict) {
  Cell cell = row();
  cell.objects.push_back({"post", Cylinder{0.02, 0.5}, small::at_xyz(0.2, -0.03, 0)});
  cell.objects.push_back({"ball", Sphere{0.02}, small::at_xyz(0.1, -0.03, 0)});
  Judged judged(cell);
  judged.question.method = TimedDiscrete{30s};  // the goal is the only instant after the start
  judged.question.rest[2] = kPi;                // c points at b, whose goal points at c
  judged.question.candidates = {judged.motion(5, kA, kUp, 0, 2s)};
  judged.question.others = {judged.motion(3, kB, kUp, kPi, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 3U);  // the pair b and c is not part of the question
  EXPECT_EQ(verdict.conflicts[0].with, With::motion);
  EXPECT_EQ(verdict.conflicts[0].other_step, StepId{JobId{3}});
  EXPECT_EQ(verdict.conflicts[1].proximity.body_b, "post");
  EXPECT_EQ(verdict.conflicts[2].proximity.body_b, "ball");
  for (const Conflict& conflict : verdict.conflicts)
    EXPECT_EQ(conflict.candidate, StepId{JobId{5}});
}

TEST(DiscreteCheck, ReportsAStaticLinkOfAnotherRobotAsScene) {
  Cell cell = row();
  Link post = small::static_link("b_post", RobotId{1}, small::at_xyz(0.3, 0, 0));
  small::add_shape(post, Sphere{0.05}, Eigen::Isometry3d::Identity());
  small::add_link(cell, post);
  Judged judged(cell);
  judged.question.candidates = {judged.motion(5, kA, kUp, 0, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, With::scene);
  EXPECT_EQ(verdict.conflicts[0].proximity.body_b, "b_post");
  EXPECT_FALSE(verdict.conflicts[0].proximity.object_b);
}

TEST(DiscreteCheck, ReportsSceneAndSelfConflicts) {
  Cell cell;
  cell.clearances.clearance_m = 0.02;
  const ArmId arm = small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {kZ, kZ, kZ}, {0.3, 0.03});
  Judged judged(cell);
  judged.question.candidates = {
      {StepId{JobId{1}}, small::sweep(*judged.cell, {arm}, {0, 0, 0}, {0, 2.8, 2.8}, 2s), 0s}};
  const Verdict self = judged();
  ASSERT_EQ(self.conflicts.size(), 1U);
  EXPECT_EQ(self.conflicts[0].with, With::self);
  EXPECT_EQ(self.conflicts[0].proximity.body_a, "a_link1");
  EXPECT_EQ(self.conflicts[0].proximity.body_b, "a_link3");

  cell.objects.push_back({"wall", Box{{2, 0.1, 2}}, small::at_xyz(0, 0.3, 0)});
  Judged walled(cell);
  walled.question.candidates = {
      {StepId{JobId{1}}, small::sweep(*walled.cell, {arm}, {0, 0, 0}, {1.5, 0, 0}, 2s), 0s}};
  const Verdict scene = walled();
  ASSERT_EQ(scene.conflicts.size(), 1U);
  EXPECT_EQ(scene.conflicts[0].with, With::scene);
  EXPECT_EQ(scene.conflicts[0].proximity.body_a, "a_link3");
}

TEST(DiscreteCheck, ChecksCandidatesAgainstEachOther) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(8, kB, kUp, kPi, 2s),
                                judged.motion(7, kA, kUp, 0, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, With::motion);
  EXPECT_EQ(verdict.conflicts[0].candidate, StepId{JobId{8}});  // comes first in the question
  EXPECT_EQ(verdict.conflicts[0].other_step, StepId{JobId{7}});
  EXPECT_EQ(verdict.conflicts[0].proximity.body_a, "b_link1");
}

TEST(DiscreteCheck, ReportsConflictsOfArmsOfOneMotionAsSelf) {
  Judged judged(row());
  judged.question.candidates = {
      {StepId{JobId{1}}, small::sweep(*judged.cell, {kA, kB}, {kUp, kUp}, {0, kPi}, 2s), 0s}};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, With::self);
}

TEST(DiscreteCheck, IgnoresConflictsBetweenOtherMotions) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(3, kA, kUp, kPi, 2s)};
  judged.question.others = {judged.motion(1, kB, kUp, 0, 2s), judged.motion(2, kC, kUp, kPi, 2s)};
  EXPECT_EQ(judged().kind, Verdict::Kind::free);
}

}  // namespace
}  // namespace armloom
