#include <gtest/gtest.h>

#include "core/collision/scene/scene_bodies.h"
#include "core/executive/holding.h"
#include "core/executive/live_scene.h"
#include "test/scenarios/polygon.h"

namespace armloom {
namespace {

CollisionObject ball_at(double x_m, const std::string& name = "ball") {
  CollisionObject object{.name = name, .shape = Sphere{0.1}};
  object.X_WO.translation().x() = x_m;
  return object;
}

TEST(Scene, NewObjectPausesTheMotionUntilItIsRemoved) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 8, "moves"));
  cell.run_until(at(2s));
  ASSERT_TRUE(cell.simulation->executive().scene().add(ball_at(0.8)));
  EXPECT_TRUE(std::holds_alternative<SceneView>(cell.log.events.back().body));
  cell.run_until(at(10s));
  EXPECT_EQ(cell.job("moves").state, JobState::paused);
  EXPECT_EQ(cell.job("moves").waits_on.front().kind, Wait::Kind::object);
  EXPECT_EQ(cell.job("moves").waits_on.front().links.back(), "ball");
  ASSERT_TRUE(cell.simulation->executive().scene().remove("ball"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("moves").state, JobState::succeeded);
}

TEST(Scene, WaitingJobIsCheckedAgainWhenTheObjectMoves) {
  Crossing cell;
  ASSERT_TRUE(cell.simulation->executive().scene().add(ball_at(0.5)));
  cell.submit(slide("x", -1, 1, 4, "waits"));
  cell.run_until(at(1s));
  EXPECT_EQ(cell.job("waits").state, JobState::backlogged);
  CollisionObject aside = ball_at(0.5);
  aside.X_WO.translation().z() = 2.0;
  ASSERT_TRUE(cell.simulation->executive().scene().replace(aside));
  cell.run_until(at(1100ms));
  EXPECT_EQ(cell.job("waits").state, JobState::running);
}

// Events of large scenes are rare. What may touch is told at once, because an audit needs the time.
TEST(Scene, TellsAtOnceWhatMayTouch) {
  Crossing cell;
  LiveScene& scene = cell.simulation->executive().scene();
  std::vector<CollisionObject> many;
  for (int i = 0; i < 200; ++i) many.push_back(ball_at(5.0 + i, "ball" + std::to_string(i)));
  ASSERT_TRUE(scene.set(many));
  ASSERT_TRUE(scene.remove("ball7"));
  const auto told = [&] { return std::get<SceneView>(cell.log.events.back().body); };
  EXPECT_EQ(told().objects().size(), 200U) << "the next event comes 20 ms later";
  const LinkId link = *scene.scene()->cell().find_link("x_ball");
  ASSERT_TRUE(scene.change(touching(*scene.scene(), "ball9", Touch{{link}, {}})));
  EXPECT_EQ(told().version, scene.version());
  EXPECT_EQ(told().objects().size(), 199U);
  ASSERT_EQ(told().touch.size(), 1U);
  EXPECT_EQ(told().touch[0].object, "ball9");
  EXPECT_EQ(told().touch[0].links, std::vector<std::string>{"x_ball"});
}

TEST(Scene, RefusesImpossibleChanges) {
  Crossing cell;
  Executive& executive = cell.simulation->executive();
  const auto in_arm = executive.scene().add(ball_at(-1.0));
  ASSERT_FALSE(in_arm);
  EXPECT_EQ(in_arm.error().front().slug, "object-in-arm");
  EXPECT_TRUE(executive.scene().objects().empty());
  ASSERT_TRUE(executive.scene().add(ball_at(1.5)));
  const std::uint64_t version = executive.scene().version();
  EXPECT_EQ(executive.scene().add(ball_at(1.8)).error().front().kind, ProblemKind::conflict);
  EXPECT_EQ(executive.scene().replace(ball_at(1.8, "other")).error().front().kind,
            ProblemKind::not_found);
  EXPECT_EQ(executive.scene().remove("other").error().front().kind, ProblemKind::not_found);
  EXPECT_EQ(executive.scene().version(), version);
}

TEST(Scene, SetReplacesAllObjectsInOneChange) {
  Crossing cell;
  LiveScene& scene = cell.simulation->executive().scene();
  ASSERT_TRUE(scene.set({ball_at(1.5, "a"), ball_at(1.8, "b")}));
  const std::uint64_t version = scene.version();
  const std::size_t events = cell.log.events.size();
  ASSERT_TRUE(scene.set({ball_at(1.8, "b"), ball_at(2.1, "c")}));
  EXPECT_EQ(scene.version(), version + 1);
  EXPECT_EQ(cell.log.events.size(), events + 1);
  ASSERT_EQ(scene.objects().size(), 2U);
  EXPECT_EQ(scene.objects()[0].name, "b");
  EXPECT_EQ(scene.objects()[1].name, "c");
}

TEST(Scene, SetKeepsTheObjectsOfTheCellFile) {
  CellDescription description = crossing_description();
  description.objects.push_back({"table", Sphere{0.1}, Eigen::Isometry3d::Identity()});
  description.objects.back().X_WO.translation().z() = 3.0;
  Crossing cell(description);
  LiveScene& scene = cell.simulation->executive().scene();
  ASSERT_TRUE(scene.set({ball_at(1.5)}));
  ASSERT_EQ(scene.objects().size(), 2U);
  EXPECT_EQ(scene.objects()[0].X_WO.translation().z(), 3.0);
  CollisionObject table = ball_at(1.8, "table");
  ASSERT_TRUE(scene.set({table}));
  ASSERT_EQ(scene.objects().size(), 1U);
  EXPECT_EQ(scene.objects()[0].X_WO.translation().x(), 1.8);
  ASSERT_TRUE(scene.set({}));
  EXPECT_EQ(scene.objects().size(), 1U);
}

TEST(Scene, SetPausesTheMotionThatMeetsOneOfManyObjects) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 8, "moves"));
  cell.run_until(at(2s));
  std::vector<CollisionObject> many;
  for (int i = 0; i < 150; ++i) many.push_back(ball_at(3.0 + i, "far " + std::to_string(i)));
  many[77] = ball_at(0.8, "near");
  ASSERT_TRUE(cell.simulation->executive().scene().set(many));
  cell.run_until(at(10s));
  EXPECT_EQ(cell.job("moves").state, JobState::paused);
  EXPECT_EQ(cell.job("moves").waits_on.front().links.back(), "near");
  ASSERT_TRUE(cell.simulation->executive().scene().set({}));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("moves").state, JobState::succeeded);
  EXPECT_GT(cell.log.closest_m, 0.0);
}

TEST(Scene, RefusedSetLeavesTheSceneAsItWas) {
  Crossing cell;
  LiveScene& scene = cell.simulation->executive().scene();
  ASSERT_TRUE(scene.set({ball_at(1.5)}));
  const PlanningScenePtr before = scene.scene();
  const auto in_arm = scene.set({ball_at(1.8), ball_at(-1.0, "in arm")});
  ASSERT_FALSE(in_arm);
  EXPECT_EQ(in_arm.error().front().slug, "object-in-arm");
  EXPECT_EQ(in_arm.error().front().pointer, "/objects/1");
  const auto doubled = scene.set({ball_at(1.8), ball_at(2.1)});
  ASSERT_FALSE(doubled);
  EXPECT_EQ(doubled.error().front().pointer, "/objects/1/name");
  const auto too_many = scene.set([] {
    std::vector<CollisionObject> all;
    for (std::size_t i = 0; i <= kObjectsMax; ++i) {
      all.push_back(ball_at(5.0, std::to_string(i)));
    }
    return all;
  }());
  ASSERT_FALSE(too_many);
  EXPECT_EQ(too_many.error().front().slug, "scene-full");
  EXPECT_EQ(scene.scene(), before);
}

// Another object may stand closer to an arm than a new one may: that is not the new one's fault.
TEST(Scene, ChangeIsRefusedOnlyForTheObjectsThatChange) {
  Crossing cell;
  LiveScene& scene = cell.simulation->executive().scene();
  ASSERT_TRUE(scene.add(ball_at(0.5)));
  cell.submit(slide("x", -1, 0.5, 4, "towards"));
  cell.run_until(at(3s));
  ASSERT_TRUE(scene.add(ball_at(2.0, "other")));
  ASSERT_TRUE(scene.remove("other"));
}

TEST(Scene, EditPreparedForAnEarlierSceneIsPreparedAgain) {
  Crossing cell;
  LiveScene& scene = cell.simulation->executive().scene();
  PreparedEdit late = prepare(ObjectPut{ball_at(1.5)}, scene.scene());
  ASSERT_TRUE(scene.add(ball_at(2.0, "between")));
  ASSERT_TRUE(scene.apply(late));
  EXPECT_EQ(scene.objects().size(), 2U);
}

TEST(Scene, KeepsFittedShapesOverChanges) {
  Crossing cell;
  LiveScene& scene = cell.simulation->executive().scene();
  ASSERT_TRUE(scene.set({ball_at(1.5, "a"), ball_at(1.8, "b")}));
  const PlanningScenePtr before = scene.scene();
  ASSERT_TRUE(scene.add(ball_at(2.1, "c")));
  const auto fitted = [](const PlanningScenePtr& of) { return of->bodies().fitted; };
  EXPECT_EQ(fitted(before), fitted(scene.scene())) << "three balls of one size are fitted once";
  EXPECT_EQ(fitted(before).size(), 1U);
}

TEST(Predecessors, DelayTheirSuccessor) {
  Crossing cell;
  cell.submit(slide("x", -1, -0.5, 2, "first"));
  JobRequest second = slide("y", -1, -0.5, 2, "second");
  second.after = {"first"};
  cell.submit(second);
  cell.run_until(at(1s));
  EXPECT_EQ(cell.job("second").state, JobState::queued);
  EXPECT_EQ(cell.job("second").waits_on.front().kind, Wait::Kind::predecessor);
  EXPECT_EQ(cell.job("second").waits_on.front().job, "first");
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("second").state, JobState::succeeded);
  EXPECT_GE(*cell.job("second").times.started_at, *cell.job("first").times.ended_at);
}

TEST(Predecessors, FailTheWholeChainWhenTheyFail) {
  Crossing cell;
  cell.submit(slide("x", -1, -0.5, 2, "first"));
  JobRequest second = slide("y", -1, -0.5, 2, "second");
  second.after = {"first"};
  cell.submit(second);
  JobRequest third = slide("x", -0.5, -1, 2, "third");
  third.after = {"second"};
  cell.submit(third);
  ASSERT_TRUE(cell.simulation->executive().cancel("first"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("second").reason(), Reason::predecessor_failed);
  EXPECT_EQ(cell.job("third").reason(), Reason::predecessor_failed);
}

TEST(Predecessors, AreRefusedIfUnknownFailedOrTheJobItself) {
  Crossing cell;
  Executive& executive = cell.simulation->executive();
  JobRequest job = slide("x", -1, -0.5, 2, "job");
  job.after = {"nobody"};
  EXPECT_EQ(executive.submit(job).error().front().pointer, "/after/0");
  job.after = {"job"};
  EXPECT_EQ(executive.submit(job).error().front().slug, "after-itself");
  cell.submit(slide("x", -1, -0.5, 2, "canceled"));
  ASSERT_TRUE(executive.cancel("canceled"));
  cell.run_to_the_end();
  job.after = {"canceled"};
  EXPECT_EQ(executive.submit(job).error().front().slug, "predecessor-failed");
}

TEST(Batch, IsAtomic) {
  Crossing cell;
  Executive& executive = cell.simulation->executive();
  JobRequest back = slide("x", -0.5, -1, 2, "back");
  back.after = {"out"};
  auto accepted = submit_batch(executive, {slide("x", -1, -0.5, 2, "out"), back}, true);
  ASSERT_TRUE(accepted);
  EXPECT_EQ(accepted->size(), 2u);

  // The second job does not start where the first ends; the third has the first job's id.
  const auto refused = submit_batch(executive,
                                    {slide("y", -1, -0.5, 2, "one"), slide("y", -1, -0.5, 2, "two"),
                                     slide("y", -0.5, -1, 2, "one")},
                                    true);
  ASSERT_FALSE(refused);
  ASSERT_EQ(refused.error().size(), 2u);
  EXPECT_EQ(refused.error()[0].pointer, "/jobs/1/trajectory/points/0/positions/0");
  EXPECT_EQ(refused.error()[1].pointer, "/jobs/2/id");
  EXPECT_FALSE(executive.job("one"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("back").state, JobState::succeeded);
}

TEST(Batch, AnswersEachJobIfNotAtomic) {
  Crossing cell;
  auto answers =
      submit_batch(cell.simulation->executive(),
                   {slide("y", 0, -0.5, 2, "bad"), slide("y", -1, -0.5, 2, "good")}, false);
  ASSERT_TRUE(answers);
  EXPECT_FALSE((*answers)[0]);
  EXPECT_TRUE((*answers)[1]);
}

TEST(Check, AnswersWithEvidenceAndChangesNothing) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "runs"));
  cell.run_until(at(100ms));
  const std::size_t events = cell.log.events.size();
  std::optional<CheckView> answer;
  const auto keep = [&](Result<CheckView> view) {
    ASSERT_TRUE(view);
    answer = *view;
  };
  cell.simulation->executive().inquiries().check(slide("y", -1, 1, 4), keep);
  cell.run_until(at(110ms));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->kind, Verdict::Kind::conflict);
  EXPECT_EQ(answer->conflicts.front().job, "runs");
  EXPECT_GT(answer->evaluations, 0u);
  EXPECT_FALSE(answer->earliest_start_s);

  cell.simulation->executive().inquiries().check(slide("y", -1, -0.5, 4), keep);
  cell.run_until(at(120ms));
  EXPECT_EQ(answer->kind, Verdict::Kind::free);
  EXPECT_EQ(answer->earliest_start_s, 0.0);

  cell.simulation->executive().inquiries().check(slide("x", 1, -1, 4), keep);
  EXPECT_EQ(answer->kind, Verdict::Kind::conflict);
  EXPECT_EQ(answer->conflicts.front().kind, Wait::Kind::predecessor);
  EXPECT_EQ(cell.log.events.size(), events);
  EXPECT_EQ(cell.simulation->executive().snapshot().jobs.size(), 1u);
}

// Each arm moves to the next arm's place: none can go alone, but all together can.
TEST(Check, UnderCoordinatedIncludesJobsThatCanStartTogether) {
  Crossing cell(polygon(3), "coordinated");
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.submit(slide("b", -1, 1, 4, "two"));
  cell.run_until(at(1s));
  ASSERT_EQ(cell.job("one").state, JobState::backlogged);
  std::optional<CheckView> answer;
  const auto keep = [&](Result<CheckView> view) {
    ASSERT_TRUE(view);
    answer = *view;
  };
  cell.simulation->executive().inquiries().check(slide("c", -1, 1, 4), keep);
  cell.run_until(at(1100ms));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->kind, Verdict::Kind::free);
  cell.submit(slide("c", -1, 1, 4, "three"));
  cell.run_to_the_end(at(20s));
  for (const char* key : {"one", "two", "three"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key;
  }
}

TEST(Check, UnderCoordinatedReportsTheBlockerOfALoneJob) {
  Crossing cell(polygon(3), "coordinated");
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.run_until(at(1s));
  std::optional<CheckView> answer;
  cell.simulation->executive().inquiries().check(
      slide("c", -1, 1, 4), [&](Result<CheckView> view) { answer = view.value(); });
  cell.run_until(at(1100ms));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->kind, Verdict::Kind::conflict);
  ASSERT_FALSE(answer->conflicts.empty());
  EXPECT_EQ(answer->conflicts.front().arm, "a");
}

TEST(Synchronous, ArmsOfOneTrajectoryStartAndEndTogether) {
  CellDescription description = crossing_description();
  description.robots[1].X_WB.translation().z() = 1.0;
  Crossing cell(description);
  JobRequest both;
  both.key = "both";
  both.trajectory.joint_names = {"y_slide", "x_slide"};
  both.trajectory.points = {{{-1, -1}, {0, 0}, {0, 0}, 0.0}, {{0.5, 1}, {0, 0}, {0, 0}, 4.0}};
  cell.submit(both);
  cell.run_until(at(2s));
  EXPECT_NEAR(cell.log.last[0] + 1, (cell.log.last[1] + 1) / 1.5 * 2, 1e-9);
  EXPECT_EQ(cell.job("both").arms, (std::vector<std::string>{"x", "y"}));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("both").state, JobState::succeeded);
}

TEST(Synchronous, FaultOfOneArmStopsTheOther) {
  CellDescription description = crossing_description();
  description.robots[1].X_WB.translation().z() = 1.0;
  Crossing cell(description);
  JobRequest both;
  both.key = "both";
  both.trajectory.joint_names = {"x_slide", "y_slide"};
  both.trajectory.points = {{{-1, -1}, {0, 0}, {0, 0}, 0.0}, {{1, 1}, {0, 0}, {0, 0}, 4.0}};
  cell.submit(both);
  cell.run_until(at(1500ms));
  ASSERT_TRUE(
      cell.simulation->executive().faults().inject({.arm = "x", .kind = ArmFault::Kind::fault}));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("both").reason(), Reason::arm_fault);
  EXPECT_LT(cell.log.last[1], 0.5) << "the sibling stopped, too";
}

// Returns a job in which x passes the crossing 40 cm before y does.
JobRequest one_after_the_other(double duration_s) {
  JobRequest both;
  both.key = "both";
  both.trajectory.joint_names = {"x_slide", "y_slide"};
  both.trajectory.points = {{{-0.8, -1.2}, {0, 0}, {0, 0}, 0.0},
                            {{1.2, 0.8}, {0, 0}, {0, 0}, duration_s}};
  return both;
}
CellDescription crossing_from_behind() {
  CellDescription cell = crossing_description();
  cell.robots[0].arms[0].home = {-0.8};
  cell.robots[1].arms[0].home = {-1.2};
  return cell;
}

TEST(Synchronous, ArmsKeepClearIfOneFallsBehind) {
  for (const char* policy : {"coordinated", "earliest_start", "certified"}) {
    Crossing cell(crossing_from_behind(), policy);
    cell.submit(one_after_the_other(8));
    ASSERT_TRUE(cell.simulation->executive().faults().inject(
        {.arm = "x", .kind = ArmFault::Kind::stall, .at = at(3500ms), .lasting = 3s}));
    cell.run_to_the_end();
    EXPECT_EQ(cell.job("both").state, JobState::succeeded) << policy;
    EXPECT_GT(cell.log.closest_m, 0.03) << policy;
  }
}

TEST(Synchronous, MotionThatAllowsNoDelayIsRefused) {
  for (const char* policy : {"coordinated", "earliest_start", "certified"}) {
    Crossing cell(crossing_from_behind(), policy);
    cell.submit(one_after_the_other(2));
    cell.run_to_the_end();
    EXPECT_EQ(cell.job("both").reason(), Reason::self_collision) << policy;
  }
}

}  // namespace
}  // namespace armloom
