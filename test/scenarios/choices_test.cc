#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Returns a motion to to_m and back to its start.
TrajectoryRequest visit(const std::string& arm, double from_m, double to_m, double seconds) {
  TrajectoryRequest motion = slide(arm, from_m, to_m, seconds / 2, "").trajectory;
  motion.points.push_back(motion.points.front());
  motion.points.back().time_from_start_s = seconds;
  return motion;
}

JobRequest visit_job(const std::string& arm, double from_m, double to_m, double seconds,
                     std::string key) {
  JobRequest request = slide(arm, from_m, to_m, seconds, std::move(key));
  request.trajectory = visit(arm, from_m, to_m, seconds);
  return request;
}

JobRequest either(double x_to_m, double y_to_m, double seconds, std::string key) {
  JobRequest request = slide("x", -1, x_to_m, seconds, std::move(key));
  request.alternatives = {visit("x", -1, x_to_m, seconds), visit("y", -1, y_to_m, seconds)};
  request.trajectory = {};
  return request;
}

// y rests in the crossing for ten seconds. x has two jobs, and only the second stays out of the
// crossing.
struct OneInTheWay {
  explicit OneInTheWay(bool reorderable) {
    JobRequest through = visit_job("x", -1, 1, 4, "through");
    JobRequest beside = visit_job("x", -1, -0.6, 4, "beside");
    through.terms.reorderable = beside.terms.reorderable = reorderable;
    JobRequest stays = visit_job("y", -1, 0, 4, "stays");
    auto& points = stays.trajectory.points;
    points.insert(points.begin() + 2, points[1]);
    for (std::size_t i = 2; i < points.size(); ++i) points[i].time_from_start_s += 10.0;
    cell.submit(std::move(stays));
    cell.run_until(at(3s));
    cell.submit(std::move(through));
    cell.submit(std::move(beside));
    cell.run_to_the_end();
  }
  Crossing cell;
};

TEST(ReorderableJobs, JobThatCanStartNowGoesFirst) {
  OneInTheWay free(true);
  const JobView beside = free.cell.job("beside"), through = free.cell.job("through");
  EXPECT_EQ(beside.state, JobState::succeeded);
  EXPECT_EQ(through.state, JobState::succeeded);
  EXPECT_LT(beside.times.ended_at, through.times.started_at);
  EXPECT_TRUE(beside.terms.reorderable);
  ASSERT_TRUE(beside.ways.choice);
  EXPECT_THAT(beside.ways.choice->candidates, ElementsAre("through", "beside"));
  EXPECT_EQ(beside.ways.choice->selected, "beside");
  EXPECT_THAT(beside.ways.choice->detail, HasSubstr("through"));
  EXPECT_EQ(free.cell.simulation->executive().figures().monitor_stops, 0U);
}

TEST(ReorderableJobs, OtherJobsKeepTheirOrder) {
  OneInTheWay given(false);
  EXPECT_LT(given.cell.job("through").times.ended_at, given.cell.job("beside").times.started_at);
  EXPECT_FALSE(given.cell.job("beside").ways.choice);
}

class ReorderableAndAlternatives : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, ReorderableAndAlternatives,
                         ::testing::ValuesIn(known_policies()));

TEST_P(ReorderableAndAlternatives, AllSucceed) {
  Crossing cell(crossing_description(), GetParam());
  std::vector<JobRequest> jobs;
  for (int round = 0; round < 3; ++round) {
    const std::string number = std::to_string(round);
    jobs.push_back(visit_job("y", -1, 1, 5, "y through " + number));
    jobs.push_back(visit_job("x", -1, 1, 5, "x through " + number));
    jobs.push_back(either(-0.6, 0.5, 4, "either " + number));
    jobs.push_back(visit_job("x", -1, -0.6, 2, "x beside " + number));
  }
  for (JobRequest& job : jobs) {
    std::ranges::replace(job.key, ' ', '-');
    job.terms.reorderable = true;
    cell.submit(job);
  }
  cell.run_to_the_end();
  for (const JobRequest& job : jobs) {
    EXPECT_EQ(cell.job(job.key).state, JobState::succeeded) << job.key;
  }
  EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0U);
}

TEST(Alternatives, AreSharedByTheArms) {
  Crossing cell;
  cell.submit(either(-0.6, -0.6, 4, "one"));
  cell.submit(either(-0.6, -0.6, 4, "two"));
  cell.run_to_the_end();
  const JobView one = cell.job("one"), two = cell.job("two");
  EXPECT_NE(one.arms, two.arms);
  EXPECT_LT(two.times.started_at, one.times.ended_at);
  EXPECT_THAT(two.ways.alternatives, ElementsAre("x", "y"));
  ASSERT_TRUE(two.ways.choice);
  EXPECT_EQ(two.ways.choice->selected, two.arms.front());
}

TEST(Alternatives, MoveToTheOtherArmIfOneIsStopped) {
  Crossing cell;
  Executive& executive = cell.simulation->executive();
  executive.stop({ArmId{0}}, "maintenance");
  for (const char* key : {"one", "two", "three"}) cell.submit(either(-0.6, -0.6, 4, key));
  cell.run_until(at(20s));
  for (const char* key : {"one", "two", "three"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key;
    EXPECT_THAT(cell.job(key).arms, ElementsAre("y")) << key;
    ASSERT_TRUE(cell.job(key).ways.choice) << key;
    EXPECT_THAT(cell.job(key).ways.choice->candidates, ElementsAre("y", "x")) << key;
    EXPECT_THAT(cell.job(key).ways.choice->detail, HasSubstr("x cannot: it is stopped")) << key;
  }
}

TEST(Alternatives, MoveToTheOtherArmIfTheStartIsNotReached) {
  Crossing cell;
  cell.submit(slide("x", -1, -0.5, 4, "leads-there"));
  JobRequest job = either(-0.6, -0.6, 4, "job");
  job.alternatives[0] = visit("x", -0.5, -0.6, 4);
  cell.submit(visit_job("y", -1, -0.6, 30, "y-is-busy"));
  cell.submit(std::move(job));
  cell.run_until(at(2s));
  EXPECT_TRUE(cell.simulation->executive().cancel("leads-there"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("job").state, JobState::succeeded);
  ASSERT_TRUE(cell.job("job").ways.choice);
  EXPECT_THAT(cell.job("job").ways.choice->candidates, ElementsAre("y", "x"));
  EXPECT_THAT(cell.job("job").ways.choice->detail, HasSubstr("x cannot: the arm will not be"));
}

TEST(Alternatives, AreRefusedIfEndsDifferOrArmsRepeat) {
  Crossing cell;
  Executive& executive = cell.simulation->executive();
  JobRequest one_way = either(-0.6, -0.6, 4, "one way");
  one_way.key = "one-way";
  one_way.alternatives[1].points.pop_back();
  const auto refused = executive.submit(one_way);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().slug, "alternative-ends-elsewhere");
  EXPECT_EQ(refused.error().front().pointer, "/alternatives/1/points/1/positions/0");
  JobRequest twice = either(-0.6, -0.6, 4, "twice");
  twice.alternatives[1] = twice.alternatives[0];
  const auto same = executive.submit(twice);
  ASSERT_FALSE(same);
  EXPECT_EQ(same.error().front().pointer, "/alternatives/1/joint_names");
  JobRequest elsewhere = either(-0.6, -0.6, 4, "elsewhere");
  for (auto& point : elsewhere.alternatives[1].points) point.positions[0] += 0.2;
  const auto off = executive.submit(elsewhere);
  ASSERT_FALSE(off);
  EXPECT_EQ(off.error().front().pointer, "/alternatives/1/points/0/positions/0");
}

}  // namespace
}  // namespace armloom
