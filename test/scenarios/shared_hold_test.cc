// Objects that hands of two arms hold at once: these arms move only together.
#include <gmock/gmock.h>

#include <atomic>
#include <cmath>

#include "core/collision/state/clearance_query.h"
#include "core/executive/holding.h"
#include "core/executive/live_scene.h"
#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kAt_m = 0.14;  // distance of each ball's center from the part: 1 cm of air

using Steps = std::vector<StepRequest>;

StepRequest move(const std::string& arm, Place_m to) {
  MotionStepRequest motion{.trajectory = {}, .arm = arm};
  motion.move_to = PlanGoal{.joints = std::vector{to.first, to.second}, .named = {}, .pose = {}};
  return {"", motion};
}
StepRequest take(const std::string& link, bool shared) {
  return {"", AttachRequest{"part", link, {}, shared}};
}
StepRequest let_go(const std::string& link = "") { return {"", DetachRequest{"part", {}, link}}; }

// Moves both balls from beside `from` to beside `to`; the second one ends `off_m` farther.
TrajectoryRequest carry(Place_m from, Place_m to, double off_m = 0.0) {
  TrajectoryRequest motion;
  motion.joint_names = {"a_x", "a_y", "b_x", "b_y"};
  const std::vector<double> zero(4, 0.0);
  const auto at = [&](Place_m place, double off) {
    return std::vector{place.first - kAt_m, place.second, place.first + kAt_m + off, place.second};
  };
  motion.points = {{at(from, 0.0), zero, zero, 0.0}, {at(to, off_m), zero, zero, 2.0}};
  return motion;
}
StepRequest carry_step(Place_m from, Place_m to, double off_m = 0.0) {
  return {"", MotionStepRequest{.trajectory = carry(from, to, off_m)}};
}

JobRequest with_steps(std::string key, Steps steps) {
  JobRequest request{.key = std::move(key), .name = "", .trajectory = {}};
  request.steps = std::move(steps);
  return request;
}
JobRequest both(std::string key, Place_m from, Place_m to) {
  return {.key = std::move(key), .name = "", .trajectory = carry(from, to)};
}

// a picks the part at the origin; b takes hold of it, too.
Steps take_both() {
  return {move("a", {-kAt_m, 0.0}), take("a_ball", false), move("b", {kAt_m, 0.0}),
          take("b_ball", true)};
}
Steps with(Steps steps, const Steps& more) {
  steps.insert(steps.end(), more.begin(), more.end());
  return steps;
}
// With both hands at the part, they carry it; then a job of the steps `then`, both still hold it.
const Steps kCarried = with(take_both(), {carry_step({0.0, 0.0}, {0.0, 0.5})});

CellDescription gantries_with_io() {
  CellDescription cell = gantries(OnIdleBlocker::park);
  cell.io.signals = {{.name = "ready", .direction = SignalDirection::input}};
  return cell;
}

// Returns what the job waits for.
std::string why(const JobView& job) {
  std::string text = job.step ? " at step " + std::to_string(*job.step) : "";
  for (const WaitView& wait : job.waits_on) {
    text += std::string("; ") + to_string(wait.kind) + " " + wait.arm + " " + wait.detail;
    for (const std::string& link : wait.links) text += " " + link;
  }
  return text;
}

struct Cell2 : TwoGantries {
  explicit Cell2(const std::string& policy = "earliest_start")
      : TwoGantries(gantries_with_io(), policy) {
    (void)executive().scene().add({.name = "part", .shape = Sphere{0.03}});
  }
  [[nodiscard]] std::vector<std::string> hands() {
    std::vector<std::string> links;
    const PlanningScene& scene = *executive().scene().scene();
    for (const LinkId link : hands_at(scene, "part")) links.push_back(scene.cell().link(link).name);
    return links;
  }
  [[nodiscard]] Problem refused(JobRequest request) {
    auto answer = executive().submit(std::move(request));
    EXPECT_FALSE(answer);
    return answer ? Problem{} : answer.error().front();
  }
  // Both arms hold the part, and the job has failed.
  void fail_while_both_hold() {
    submit(with_steps("carry", with(kCarried, {{"", WaitIoRequest{"ready", true, 1s}},
                                               let_go("a_ball"),
                                               move("a", {-1.0, 0.5}),
                                               move("b", {1.0, 0.5}),
                                               let_go(),
                                               move("b", {2.0, 0.5})})));
    submit(to_place("a", {-1.0, 0.0}, "behind"));
    while (!is_terminal(job("carry").state) && now() < at(60s)) run_until(now() + 100ms);
    EXPECT_EQ(job("carry").state, JobState::failed) << why(job("carry"));
    EXPECT_THAT(hands(), ElementsAre("a_ball", "b_ball"));
  }
};

TEST(SharedHold, CarriesAnObjectInTwoHandsThenOneLetsGo) {
  for (const std::string& policy : known_policies()) {
    for (const bool first_stays : {true, false}) {
      Cell2 cell(policy);
      const std::string stays = first_stays ? "a" : "b", leaves = first_stays ? "b" : "a";
      const double side = first_stays ? -1.0 : 1.0;
      cell.submit(
          with_steps("hand over",
                     with(kCarried, {carry_step({0.0, 0.5}, {0.2, 0.2}), let_go(leaves + "_ball"),
                                     move(leaves, {-side, 0.2}), move(stays, {side * kAt_m, -0.5}),
                                     let_go(), move(stays, {side, -0.5})})));
      bool was_shared = false;
      while (!cell.executive().all_ended() && cell.now() < at(100s)) {
        cell.run_until(cell.now() + 10ms);
        if (cell.hands().size() < 2) continue;
        was_shared = true;
        const Configuration& q = cell.measured();
        EXPECT_NEAR(q[2] - q[0], 2 * kAt_m, 1e-4) << policy;
        EXPECT_NEAR(q[3], q[1], 1e-4) << policy;
      }
      const JobView job = cell.job("hand over");
      EXPECT_EQ(job.state, JobState::succeeded) << policy << ": " << job.detail() << why(job);
      EXPECT_TRUE(was_shared) << policy;
      ASSERT_EQ(cell.executive().scene().objects().size(), 1U) << policy;
      const Eigen::Vector3d place = cell.executive().scene().objects().front().X_WO.translation();
      EXPECT_NEAR(place.x(), 0.0, 1e-3) << policy << stays;
      EXPECT_NEAR(place.y(), -0.5, 1e-3) << policy;
      EXPECT_TRUE(cell.executive().scene().scene()->touch().empty()) << policy;
    }
  }
}

TEST(SharedHold, RefusesWhatWouldTearTheObject) {
  const auto taken = [](const Steps& then) { return with(take_both(), then); };
  const Steps leave{let_go(), move("a", {-1.0, 0.0}), move("b", {1.0, 0.0})};
  struct Case {
    Steps steps;
    const char* slug;
    const char* pointer;
  };
  const std::vector<Case> cases{
      {taken(with({move("a", {-1.0, 0.0})}, leave)), "moves-alone", "/steps/4/move_to"},
      {taken(with(
           {{"", MotionStepRequest{.trajectory =
                                       go("b", {kAt_m, 0.0}, {kAt_m, 0.5}, 2.0, "").trajectory}}},
           leave)),
       "moves-alone", "/steps/4/trajectory/joint_names"},
      {taken(with({carry_step({0.0, 0.0}, {0.0, 0.5}, 0.01)}, leave)), "hands-apart",
       "/steps/4/trajectory"},
      {with({move("a", {-kAt_m, 0.0}), take("a_ball", true)}, leave), "not-held",
       "/steps/1/attach/shared"},
      {with({move("a", {-kAt_m, 0.0}), take("a_ball", false), take("a_ball", true)}, leave),
       "held-twice", "/steps/2/attach/object"},
      {with({move("a", {-kAt_m, 0.0}), take("a_ball", false), let_go("b_ball")}, leave), "not-held",
       "/steps/2/detach/link"},
      {with({move("a", {-kAt_m, 0.0}), take("a_ball", false), let_go("c_ball")}, leave),
       "unknown-link", "/steps/2/detach/link"},
      {take_both(), "no-motion-after", "/steps/1/attach/link"},
      {taken({let_go("a_ball"), move("a", {-1.0, 0.0})}), "no-motion-after",
       "/steps/3/attach/link"},
  };
  for (const Case& one : cases) {
    Cell2 cell;
    const Problem problem = cell.refused(with_steps("bad", one.steps));
    EXPECT_EQ(problem.slug, one.slug) << problem.pointer << problem.detail;
    EXPECT_EQ(problem.pointer, one.pointer) << one.slug;
    std::string asked;
    cell.executive().inquiries().check(with_steps("bad", one.steps), [&](const auto& answer) {
      if (!answer) asked = answer.error().front().slug;
    });
    EXPECT_EQ(asked, one.slug);
  }
}

// Each job by itself is within the tolerance.
TEST(SharedHold, SeesHandsThatPartALittleWithEachJob) {
  Cell2 cell;
  ASSERT_TRUE(cell.executive().submit(
      with_steps("first", with(take_both(), {carry_step({0.0, 0.0}, {0.0, 0.5}, 0.0009)}))));
  while (!cell.executive().all_ended() && cell.now() < at(60s)) cell.run_until(cell.now() + 100ms);
  ASSERT_EQ(cell.hands().size(), 2U);
  JobRequest second{
      .key = "second", .name = "", .trajectory = carry({0.0, 0.5}, {0.0, 0.0}, 0.0018)};
  second.trajectory.points.front().positions[2] += 0.0009;
  const Problem problem = cell.refused(std::move(second));
  EXPECT_EQ(problem.slug, "hands-apart") << problem.detail;
}

// At most half the tolerance is seen at samples; between them the hands part by more.
TEST(SharedHold, SeesHandsThatPartBetweenTwoWaypoints) {
  Cell2 cell;
  TrajectoryRequest motion = carry({0.0, 0.0}, {0.0, 0.5});
  auto& points = motion.points;
  points.insert(points.begin() + 1, points.front());
  points[1].time_from_start_s = 1.0;
  points[1].positions = {-kAt_m, 0.25, kAt_m, 0.25};
  points[1].velocities = {0.0, 0.5, 0.02, 0.5};  // the second hand swings out and back
  const Problem problem = cell.refused(
      with_steps("bad", with(take_both(), {{"", MotionStepRequest{.trajectory = motion}},
                                           let_go(),
                                           move("a", {-1.0, 0.5}),
                                           move("b", {1.0, 0.5})})));
  EXPECT_EQ(problem.slug, "hands-apart");
}

TEST(SharedHold, KeepsOtherJobsWaitingUntilTheObjectIsLetGo) {
  Cell2 cell;
  cell.fail_while_both_hold();
  cell.run_until(cell.now() + 2s);
  const JobView behind = cell.job("behind");
  EXPECT_FALSE(is_terminal(behind.state));
  ASSERT_EQ(behind.waits_on.size(), 1U);
  EXPECT_EQ(behind.waits_on[0].kind, Wait::Kind::holding);
  EXPECT_EQ(behind.waits_on[0].arm, "b");
  EXPECT_THAT(behind.waits_on[0].detail, HasSubstr("POST /scene/objects/part/detach"));

  const Problem alone = cell.refused(to_place("b", {1.0, 0.0}, "alone"));
  EXPECT_EQ(alone.slug, "moves-alone");
  EXPECT_EQ(alone.pointer, "/move_to");
  EXPECT_EQ(alone.kind, ProblemKind::conflict);
  std::string plan;
  cell.executive().inquiries().plan(
      PlanInquiry{.arm = "b", .arms = {}, .to = *to_place("b", {1.0, 0.0}, "").move_to, .from = {}},
      std::make_shared<std::atomic<bool>>(false), [&](const auto& answer) {
        if (!answer) plan = answer.error().front().slug;
      });
  EXPECT_EQ(plan, "moves-alone");
  EXPECT_EQ(cell.refused(with_steps("alone", {move("a", {-1.0, 0.0})})).slug, "moves-alone");

  EXPECT_TRUE(cell.executive().cancel("behind"));
  cell.submit(both("both", {0.0, 0.5}, {0.0, -0.5}));
  cell.submit(
      with_steps("let go", {let_go("a_ball"), move("a", {-1.0, -0.5}), move("b", {0.5, -0.5})}));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("both").state, JobState::succeeded) << cell.job("both").detail();
  EXPECT_EQ(cell.job("let go").state, JobState::succeeded) << cell.job("let go").detail();
  EXPECT_THAT(cell.hands(), ElementsAre("b_ball"));
  cell.submit(to_place("a", {-1.0, 0.0}, "free"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("free").state, JobState::succeeded);
}

TEST(SharedHold, ContinuesWhenAnOperatorHasLetTheObjectGo) {
  Cell2 cell;
  cell.fail_while_both_hold();
  ASSERT_TRUE(cell.executive().detach("part"));
  EXPECT_THAT(cell.hands(), ElementsAre());
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("behind").state, JobState::succeeded);
}

// An arm that may not move alone does not retreat for another one.
TEST(SharedHold, DoesNotRetreatAlone) {
  CellDescription three = gantries(OnIdleBlocker::park, {{-1.0, 0.0}, {1.0, 0.0}, {0.0, 1.5}});
  TwoGantries cell(three, "earliest_start");
  (void)cell.executive().scene().add({.name = "part", .shape = Sphere{0.03}});
  cell.submit(with_steps("carry", kCarried));
  cell.run_to_the_end();
  JobRequest crosses = to_place("c", {0.0, -1.0}, "crosses");
  crosses.move_to.reset();
  crosses.trajectory = go("c", {0.0, 1.5}, {0.0, -1.0}, 4.0, "").trajectory;
  cell.submit(crosses);
  cell.run_until(cell.now() + 5s);
  EXPECT_EQ(cell.job("crosses").state, JobState::backlogged);
  EXPECT_NEAR(cell.measured()[0], -kAt_m, 1e-3);
  EXPECT_NEAR(cell.measured()[2], kAt_m, 1e-3);
}

TEST(SharedHold, ChangesHandsIfASecondHandTakesItAlone) {
  Cell2 cell;
  cell.submit(with_steps("take", with(kCarried, {take("b_ball", false), move("a", {-1.0, 0.5}),
                                                 move("b", {0.5, 0.5})})));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("take").state, JobState::succeeded) << cell.job("take").detail();
  EXPECT_THAT(cell.hands(), ElementsAre("b_ball"));
}

TEST(SharedHold, IsRestored) {
  Cell2 before;
  before.fail_while_both_hold();
  const HeldView held = place_of(*before.executive().scene().scene(), "part");
  ASSERT_EQ(held.shared_with.size(), 1U);
  EXPECT_EQ(held.shared_with[0].arm, "b");

  Cell2 after;
  ASSERT_TRUE(after.executive().scene().remove("part"));
  ASSERT_TRUE(after.executive().scene().hold(held));
  EXPECT_THAT(after.hands(), ElementsAre("a_ball", "b_ball"));
  const HeldView again = place_of(*after.executive().scene().scene(), "part");
  EXPECT_TRUE(again.shared_with[0].X_LO.isApprox(held.shared_with[0].X_LO));
  EXPECT_EQ(after.refused(to_place("b", {1.0, 0.5}, "alone")).slug, "moves-alone");
}

}  // namespace
}  // namespace armloom
