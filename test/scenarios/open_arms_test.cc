#include <gmock/gmock.h>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

JobRequest either(double to_m, std::string key, std::vector<std::string> arms = {"x", "y"}) {
  JobRequest request{.key = std::move(key), .name = "", .trajectory = {}};
  request.arms = std::move(arms);
  request.move_to = PlanGoal{.joints = std::vector{to_m}, .named = {}, .pose = {}};
  return request;
}

JobRequest one(const std::string& arm, double to_m, std::string key) {
  JobRequest request = either(to_m, std::move(key), {});
  request.arm = arm;
  return request;
}

// Makes a job slow, so that its arm stays busy for a while.
JobRequest slow(JobRequest request) {
  request.speed = 0.1;
  return request;
}

class CandidateArms : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { cell.emplace(crossing_description(), GetParam()); }
  [[nodiscard]] Executive& executive() const { return cell->simulation->executive(); }
  std::optional<Crossing> cell;
};
INSTANTIATE_TEST_SUITE_P(Policies, CandidateArms, ::testing::ValuesIn(known_policies()));

TEST_P(CandidateArms, NearestArmIsSelected) {
  cell->submit(slide("y", -1.0, -0.6, 1.0));
  cell->run_until(at(2s));
  const JobView accepted = cell->submit(either(-0.5, "job"));
  EXPECT_EQ(accepted.motion.planned, false);
  EXPECT_THAT(accepted.ways.alternatives, ElementsAre("x", "y"));
  cell->run_to_the_end();
  const JobView job = cell->job("job");
  EXPECT_EQ(job.state, JobState::succeeded) << job.detail();
  EXPECT_THAT(job.arms, ElementsAre("y"));
  EXPECT_THAT(job.ways.alternatives, ElementsAre("x", "y"));
  ASSERT_TRUE(job.ways.choice);
  EXPECT_EQ(job.ways.choice->selected, "y");
  EXPECT_THAT(job.ways.choice->detail, HasSubstr("sooner than x"));
  EXPECT_GT(job.ways.choice->time_saved_s.value_or(0.0), 0.1);
  EXPECT_NEAR(cell->log.last[0], -1.0, 1e-3);
  EXPECT_NEAR(cell->log.last[1], -0.5, 1e-3);
}

TEST_P(CandidateArms, BusyArmIsNotSelected) {
  cell->submit(slow(one("x", -0.5, "long")));
  cell->run_until(at(300ms));
  cell->submit(either(-0.9, "job"));
  cell->run_to_the_end();
  EXPECT_EQ(cell->job("job").state, JobState::succeeded) << cell->job("job").detail();
  EXPECT_THAT(cell->job("job").arms, ElementsAre("y"));
}

TEST_P(CandidateArms, StoppedArmIsNotSelected) {
  executive().stop({ArmId{0}}, "maintenance");
  cell->submit(either(-0.5, "job"));
  cell->run_until(at(10s));
  EXPECT_EQ(cell->job("job").state, JobState::succeeded) << cell->job("job").detail();
  EXPECT_THAT(cell->job("job").arms, ElementsAre("y"));
  EXPECT_THAT(cell->job("job").ways.choice->detail, HasSubstr("x cannot: it is stopped"));
}

TEST_P(CandidateArms, ArmWithoutAPathIsReportedWithItsReason) {
  CollisionObject post{.name = "post", .shape = Box{{0.1, 0.1, 0.1}}};
  post.X_WO.translation() = Eigen::Vector3d(-0.5, 0.0, 0.0);
  ASSERT_TRUE(executive().scene().add(post));
  cell->submit(either(-0.4, "job"));
  cell->run_to_the_end();
  const JobView job = cell->job("job");
  EXPECT_EQ(job.state, JobState::succeeded) << job.detail();
  EXPECT_THAT(job.arms, ElementsAre("y"));
  ASSERT_TRUE(job.ways.choice);
  EXPECT_THAT(job.ways.choice->detail, HasSubstr("x cannot: no plan"));
}

TEST_P(CandidateArms, ArmThatTouchesAnObjectIsNotSelected) {
  const auto hand = [](const char* name, double x_m, double y_m) {
    CollisionObject object{.name = name, .shape = Box{{0.1, 0.1, 0.1}}};
    object.X_WO.translation() = Eigen::Vector3d(x_m, y_m, 0.0);
    return object;
  };
  ASSERT_TRUE(executive().scene().add(hand("at x", -1.0, 0.165)));
  cell->submit(either(-0.5, "by y"));
  cell->run_to_the_end();
  EXPECT_THAT(cell->job("by y").arms, ElementsAre("y"));
  ASSERT_TRUE(executive().scene().add(hand("at y", 0.165, -0.5)));
  cell->submit(either(-0.7, "by whom"));
  cell->submit(either(-0.8, "and then"));
  cell->run_until(cell->simulation->now() + 5s);
  EXPECT_EQ(cell->job("by whom").state, JobState::backlogged) << cell->job("by whom").detail();
  ASSERT_FALSE(cell->job("by whom").waits_on.empty());
  EXPECT_EQ(cell->job("by whom").waits_on[0].kind, Wait::Kind::object);
  ASSERT_TRUE(executive().scene().remove("at y"));
  cell->run_to_the_end(at(60s));
  for (const char* key : {"by whom", "and then"}) {
    EXPECT_EQ(cell->job(key).state, JobState::succeeded) << cell->job(key).detail();
    EXPECT_THAT(cell->job(key).arms, ElementsAre("y"));
  }
}

TEST_P(CandidateArms, JobFailsWithEachArmsReason) {
  for (const auto& [name, x, y] : {std::tuple("a", 0.5, 0.0), std::tuple("b", 0.0, 0.5)}) {
    CollisionObject post{.name = name, .shape = Box{{0.1, 0.1, 0.1}}};
    post.X_WO.translation() = Eigen::Vector3d(x, y, 0.0);
    ASSERT_TRUE(executive().scene().add(post));
  }
  cell->submit(either(0.5, "job"));
  cell->submit(either(-0.5, "next"));
  cell->run_to_the_end();
  const JobView job = cell->job("job");
  EXPECT_EQ(job.reason(), Reason::no_plan);
  EXPECT_THAT(job.detail(), HasSubstr("x: no plan"));
  EXPECT_THAT(job.detail(), HasSubstr("; y: no plan"));
  EXPECT_EQ(cell->job("next").state, JobState::succeeded);
}

TEST_P(CandidateArms, JobsAreSharedByTheArms) {
  for (const auto& [key, to_m] :
       {std::pair("a", -0.7), std::pair("b", -0.6), std::pair("c", -0.5), std::pair("d", -0.8)}) {
    cell->submit(slow(either(to_m, key)));
  }
  cell->submit(one("x", -0.4, "then x"));
  cell->submit(one("y", -0.4, "then y"));
  cell->run_to_the_end(at(120s));
  std::set<std::string> arms;
  for (const char* key : {"a", "b", "c", "d"}) {
    EXPECT_EQ(cell->job(key).state, JobState::succeeded) << cell->job(key).detail();
    arms.insert(cell->job(key).arms.at(0));
  }
  EXPECT_EQ(arms.size(), 2U) << "one arm does it all";
  for (const char* key : {"then x", "then y"}) {
    EXPECT_EQ(cell->job(key).state, JobState::succeeded) << cell->job(key).detail();
  }
}

// Both trajectories behind the job are submitted before it is known which arm takes the job.
TEST_P(CandidateArms, NextTrajectoryMayStartAtEitherOutcome) {
  cell->submit(slide("y", -1.0, -0.6, 1.0));
  cell->run_until(at(2s));
  cell->submit(either(-0.5, "job"));
  cell->submit(slide("y", -0.5, -0.8, 1.0, "back"));
  cell->submit(slide("x", -1.0, -0.8, 1.0, "other"));
  cell->run_to_the_end();
  for (const char* key : {"job", "back", "other"}) {
    EXPECT_EQ(cell->job(key).state, JobState::succeeded) << key << cell->job(key).detail();
  }
}

TEST_P(CandidateArms, ImpossibleJobsAreRefusedAtOnce) {
  const auto refused = [&](JobRequest request, const std::string& pointer) {
    const auto answer = executive().submit(std::move(request));
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().front().pointer, pointer) << answer.error().front().detail;
  };
  refused(either(0.5, "a", {"x", "z"}), "/arms/1");
  refused(either(0.5, "b", {"x", "y", "x"}), "/arms/2");
  refused(either(7.0, "c"), "/move_to/joints/0");
  JobRequest link = either(0.0, "d");
  link.move_to = PlanGoal{.joints = {}, .named = {}, .pose = PlanPose{.link = "x_ball"}};
  refused(link, "/arms/1");
  JobRequest trajectory = slide("x", -1, 0, 2, "e");
  trajectory.arms = {"x", "y"};
  refused(trajectory, "/arms");
}

TEST_P(CandidateArms, PoseGoalAppliesToALinkOfTheCandidateArm) {
  for (const auto& link : {std::optional<std::string>(), std::optional<std::string>("ball")}) {
    JobRequest request = either(0.0, link ? "named" : "last");
    request.move_to = PlanGoal{.joints = {}, .named = {}, .pose = PlanPose{.link = link}};
    request.move_to->pose->X_WL.translation().y() = -0.4;
    request.move_to->pose->X_WL.linear() =
        Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    cell->submit(request);
    cell->run_to_the_end();
    const JobView job = cell->job(request.key);
    EXPECT_EQ(job.state, JobState::succeeded) << job.detail();
    EXPECT_THAT(job.arms, ElementsAre("y"));
    cell->submit(one("y", -0.8, ""));
    cell->run_to_the_end();
  }
}

}  // namespace
}  // namespace armloom
