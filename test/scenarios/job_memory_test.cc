// Trajectories dominate the memory of jobs.
#include <gtest/gtest.h>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

constexpr std::size_t kWaypoints = 1000;
constexpr std::size_t kBytes = kWaypoints * 7 * sizeof(double);  // of one such job, approximately

// Returns a small motion from home along x and back, in many short pieces.
JobRequest long_slide(std::string key) {
  JobRequest request{.key = std::move(key), .name = "", .trajectory = {}};
  request.trajectory.joint_names = {"x_slide"};
  for (std::size_t i = 0; i <= kWaypoints; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kWaypoints);
    const double angle = 2 * std::numbers::pi * share;
    const double rate = 2 * std::numbers::pi;  // in 1 s
    request.trajectory.points.push_back(
        {{-1.0 + 0.01 * (1 - std::cos(angle))}, {0.01 * rate * std::sin(angle)}, {}, share});
  }
  for (WaypointRequest* end :
       {&request.trajectory.points.front(), &request.trajectory.points.back()})
    end->velocities = {0.0};
  return request;
}

class JobMemory : public ::testing::Test {
 protected:
  void begin(ExecutiveOptions options) {
    auto created = Simulation::create(*build_cell(crossing_description()), std::move(options), log);
    ASSERT_TRUE(created);
    simulation = std::move(*created);
    simulation->tick();
  }
  [[nodiscard]] Executive& executive() { return simulation->executive(); }
  void run_to_the_end() {
    while (!executive().all_ended() && simulation->now() < at(60s)) simulation->tick();
    ASSERT_TRUE(executive().all_ended());
  }

  Log log;
  std::unique_ptr<Simulation> simulation;
};

TEST_F(JobMemory, RefusesJobsBeyondTheBoundUntilOneEnds) {
  begin({.active_bytes_max = 5 * kBytes / 2});
  ASSERT_TRUE(executive().submit(long_slide("one")));
  ASSERT_TRUE(executive().submit(long_slide("two")));
  const auto refused = executive().submit(long_slide("three"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().kind, ProblemKind::unavailable);
  EXPECT_EQ(refused.error().front().slug, "trajectories-full");
  ASSERT_TRUE(executive().cancel("two"));
  EXPECT_TRUE(executive().submit(long_slide("three")));
}

TEST_F(JobMemory, ForgetsTheOldestEndedJobsBeyondTheBound) {
  begin({.ended_bytes_max = 5 * kBytes / 2});
  for (const char* key : {"one", "two", "three", "four"}) {
    ASSERT_TRUE(executive().submit(long_slide(key)));
  }
  run_to_the_end();
  EXPECT_FALSE(executive().job("one"));
  EXPECT_FALSE(executive().job("two"));
  EXPECT_TRUE(executive().job("three"));
  EXPECT_TRUE(executive().job("four"));
}

TEST_F(JobMemory, KeepsTheJobThatEndedLast) {
  begin({.ended_bytes_max = kBytes / 2});
  ASSERT_TRUE(executive().submit(long_slide("one")));
  run_to_the_end();
  EXPECT_TRUE(executive().job("one"));
}

}  // namespace
}  // namespace armloom
