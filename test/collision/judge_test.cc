#include <gtest/gtest.h>

#include "core/collision/check/timed_discrete_check.h"
#include "test/collision/scaled_query.h"
#include "test/collision/small_cell.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using With = Conflict::With;
const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();

// Three arms in a row along x, bases 0.7 m apart, each one link of 0.4 m that turns about z: at
// zero it points to its right neighbour, at pi to its left one. Two neighbours that point at each
// other overlap; one that points there while the other points up (pi/2) does not.
Cell row() {
  Cell cell;
  cell.clearance_m = 0.02;
  small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {kZ}, 0.4, 0.03);
  small::add_robot(cell, "b", small::at_xyz(0.7, 0, 0), {kZ}, 0.4, 0.03);
  small::add_robot(cell, "c", small::at_xyz(1.4, 0, 0), {kZ}, 0.4, 0.03);
  return cell;
}
const ArmId kA{0};
const ArmId kB{1};
const ArmId kC{2};
constexpr double kPi = small::kHalfTurn;
constexpr double kUp = kPi / 2;

struct Judged {
  explicit Judged(Cell made)
      : cell(small::shared(std::move(made))), checker(*PlanningScene::build(cell)) {
    question.version = 42;
    question.start_at = at(0s);
    question.rest = Configuration::Constant(static_cast<Eigen::Index>(cell->joints.size()), kUp);
    question.method = TimedDiscrete{50ms};
  }
  Motion motion(std::uint64_t job, ArmId arm, double from, double to, Duration duration,
                Duration progress = 0s) const {
    return {JobId{job}, small::sweep(*cell, {arm}, {from}, {to}, duration), progress};
  }
  Verdict operator()() { return timed_discrete_check(question, checker); }

  CellPtr cell;
  small::ScaledQuery checker;
  Question question;
};

TEST(Judge, IsFreeWhenNothingIsNearAndLooksAtEveryStepAndTheEnd) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(1, kA, kUp, kPi, 1010ms)};
  const Verdict verdict = judged();
  EXPECT_EQ(verdict.kind, Verdict::Kind::free);
  EXPECT_EQ(verdict.version, 42U);
  EXPECT_TRUE(verdict.conflicts.empty());
  EXPECT_FALSE(verdict.clearance_bound.has_value());
  EXPECT_EQ(verdict.evaluations, 22U);  // 0, 50, ..., 1000 and 1010 ms
}

// The defect T2: half of b's motion is done, only what remains may count.
TEST(Judge, ComparesWithTheRemainingMotion) {
  Judged judged(row());
  // b leaves a's side within its first half; a turns there in the meantime.
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 4s)};
  judged.question.others = {judged.motion(1, kB, kPi, 0, 4s, 2s)};
  EXPECT_EQ(judged().kind, Verdict::Kind::free);

  // The same, but b does in its second half what a's clock would call its first.
  judged.question.others = {judged.motion(1, kB, 0, kPi, 4s, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.kind, Verdict::Kind::conflict);
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  const Conflict& conflict = verdict.conflicts[0];
  EXPECT_EQ(conflict.with, With::motion);
  EXPECT_EQ(conflict.candidate, JobId{2});
  EXPECT_EQ(conflict.other_job, JobId{1});
  EXPECT_EQ(conflict.proximity.body_a, "a_link1");
  EXPECT_EQ(conflict.proximity.body_b, "b_link1");
  EXPECT_EQ(conflict.other_time, std::min<Duration>(conflict.own_time + 2s, 4s));
  EXPECT_GT(conflict.own_time, 1s);
  EXPECT_LT(conflict.proximity.clearance_m, 0.02);
}

// The defect T3: the other's rest counts before and after its motion.
TEST(Judge, FindsTheRestAfterAShorterMotion) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(2, kA, kPi, 0, 8s)};
  judged.question.others = {judged.motion(1, kB, kUp, kPi, 1s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, With::motion);
  EXPECT_EQ(verdict.conflicts[0].other_time, 1s);  // at its goal
  EXPECT_GT(verdict.conflicts[0].own_time, 4s);
}

TEST(Judge, FindsTheOwnRestThatALongerMotionPassesThrough) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 1s)};
  judged.question.others = {judged.motion(1, kB, 0, kPi, 8s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].own_time, 1s);
  EXPECT_GT(verdict.conflicts[0].other_time, 4s);
}

TEST(Judge, FindsTheRestBeforeAMotionThatIsStillToStart) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 2s)};
  judged.question.others = {judged.motion(1, kB, kPi, 0, 2s, -10s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].other_time, 0s);
  judged.question.others = {judged.motion(1, kB, kPi, 0, 2s, 0s)};
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 2s, -2s)};
  EXPECT_EQ(judged().kind, Verdict::Kind::free);
}

TEST(Judge, NamesAnArmAtRestThatNoJobWillMove) {
  Judged judged(row());
  judged.question.rest[1] = kPi;
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, With::rest);
  EXPECT_EQ(verdict.conflicts[0].proximity.arm_b, kB);
  EXPECT_FALSE(verdict.conflicts[0].other_job.has_value());
}

TEST(Judge, PutsTheCandidateFirstInTheEvidenceWhicheverArmItIs) {
  Judged judged(row());
  judged.question.rest[0] = 0;
  judged.question.candidates = {judged.motion(2, kB, kUp, kPi, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].proximity.body_a, "b_link1");
  EXPECT_EQ(verdict.conflicts[0].proximity.arm_a, kB);
  EXPECT_EQ(verdict.conflicts[0].proximity.body_b, "a_link1");
}

TEST(Judge, NamesEachCounterpartOfTheFirstInstantThatHasOne) {
  Cell cell = row();
  cell.objects.push_back({"post", Cylinder{0.02, 0.5}, small::at_xyz(0.2, -0.03, 0)});
  cell.objects.push_back({"ball", Sphere{0.02}, small::at_xyz(0.1, -0.03, 0)});
  Judged judged(cell);
  judged.question.method = TimedDiscrete{30s};  // the goal is the only instant after the start
  judged.question.rest[2] = kPi;                // c points at b, which will point at it
  judged.question.candidates = {judged.motion(5, kA, kUp, 0, 2s)};
  judged.question.others = {judged.motion(3, kB, kUp, kPi, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 3U);  // b and c among themselves are not the question
  EXPECT_EQ(verdict.conflicts[0].with, With::motion);
  EXPECT_EQ(verdict.conflicts[0].other_job, JobId{3});
  EXPECT_EQ(verdict.conflicts[1].proximity.body_b, "post");
  EXPECT_EQ(verdict.conflicts[2].proximity.body_b, "ball");
  for (const Conflict& conflict : verdict.conflicts) EXPECT_EQ(conflict.candidate, JobId{5});
}

TEST(Judge, NamesTheStaticLinkOfAnotherRobotAsScene) {
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

// What the discrete check promises, and what it does not: the defect T4.
TEST(Judge, MissesAThinRodBetweenCoarseStepsAndFindsItWithFineOnes) {
  Cell cell = row();
  cell.clearance_m = 0.001;
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

// The last instant is the end itself, not the last multiple of the step.
TEST(Judge, LooksAtTheGoalEvenWhenTheStepIsLongerThanTheMotion) {
  Judged judged(row());
  judged.question.rest[1] = kPi;
  judged.question.candidates = {judged.motion(2, kA, kUp, 0, 1s)};
  judged.question.method = TimedDiscrete{30s};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].own_time, 1s);
  EXPECT_EQ(verdict.evaluations, 2U);
}

TEST(Judge, LetsAPairThatIsTooClosePart) {
  Judged judged(row());
  judged.question.rest[1] = kPi;
  judged.question.candidates = {judged.motion(2, kA, 0, kUp, 2s)};  // out of an overlap
  EXPECT_EQ(judged().kind, Verdict::Kind::free);
}

TEST(Judge, CallsItAConflictWhenAPairThatIsTooCloseComesCloser) {
  Judged judged(row());
  judged.question.rest[1] = kPi;
  // tips side by side: closest when parallel, at 0; from 0.12 the distance is below the clearance
  judged.question.candidates = {judged.motion(2, kA, 0.12, -0.12, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_GT(verdict.conflicts[0].own_time, 0s);
}

TEST(Judge, AllowsNoReturnOncePartedPairsHaveCleared) {
  Judged judged(row());
  judged.question.rest[1] = kPi;
  auto there = small::sweep(*judged.cell, {kA}, {0.0}, {kUp}, 2s)->segments();
  auto back = small::sweep(*judged.cell, {kA}, {kUp}, {0.0}, 2s)->segments();
  back[0].start = 2s;
  there.push_back(back[0]);
  const auto joints = judged.cell->arm(kA).joints;
  judged.question.candidates = {
      {JobId{2}, std::make_shared<const Trajectory>(joints, std::vector{kA}, there), 0s}};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_GT(verdict.conflicts[0].own_time, 3s);
}

TEST(Judge, KnowsTheSceneAndTheCandidatesOwnLinks) {
  Cell cell;
  cell.clearance_m = 0.02;
  const ArmId arm = small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {kZ, kZ, kZ}, 0.3, 0.03);
  Judged judged(cell);
  judged.question.candidates = {
      {JobId{1}, small::sweep(*judged.cell, {arm}, {0, 0, 0}, {0, 2.8, 2.8}, 2s), 0s}};
  const Verdict self = judged();
  ASSERT_EQ(self.conflicts.size(), 1U);
  EXPECT_EQ(self.conflicts[0].with, With::self);
  EXPECT_EQ(self.conflicts[0].proximity.body_a, "a_link1");
  EXPECT_EQ(self.conflicts[0].proximity.body_b, "a_link3");

  cell.objects.push_back({"wall", Box{{2, 0.1, 2}}, small::at_xyz(0, 0.3, 0)});
  Judged walled(cell);
  walled.question.candidates = {
      {JobId{1}, small::sweep(*walled.cell, {arm}, {0, 0, 0}, {1.5, 0, 0}, 2s), 0s}};
  const Verdict scene = walled();
  ASSERT_EQ(scene.conflicts.size(), 1U);
  EXPECT_EQ(scene.conflicts[0].with, With::scene);
  EXPECT_EQ(scene.conflicts[0].proximity.body_a, "a_link3");
}

TEST(Judge, ChecksCandidatesAgainstEachOther) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(8, kB, kUp, kPi, 2s),
                                judged.motion(7, kA, kUp, 0, 2s)};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, With::motion);
  EXPECT_EQ(verdict.conflicts[0].candidate, JobId{8});  // named first
  EXPECT_EQ(verdict.conflicts[0].other_job, JobId{7});
  EXPECT_EQ(verdict.conflicts[0].proximity.body_a, "b_link1");
}

TEST(Judge, CallsTheArmsOfOneSynchronousMotionItself) {
  Judged judged(row());
  judged.question.candidates = {
      {JobId{1}, small::sweep(*judged.cell, {kA, kB}, {kUp, kUp}, {0, kPi}, 2s), 0s}};
  const Verdict verdict = judged();
  ASSERT_EQ(verdict.conflicts.size(), 1U);
  EXPECT_EQ(verdict.conflicts[0].with, With::self);
}

TEST(Judge, LeavesOthersAmongThemselvesAlone) {
  Judged judged(row());
  judged.question.candidates = {judged.motion(3, kA, kUp, kPi, 2s)};
  judged.question.others = {judged.motion(1, kB, kUp, 0, 2s), judged.motion(2, kC, kUp, kPi, 2s)};
  EXPECT_EQ(judged().kind, Verdict::Kind::free);
}

TEST(Judge, AnswersTheSameQuestionTheSameWay) {
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

TEST(Judge, RefusesBrokenQuestions) {
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
