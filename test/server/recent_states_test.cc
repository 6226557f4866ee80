#include "server/hub/recent_states.h"

#include <gtest/gtest.h>

#include "test/server/durable_server.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

RecentStates::Clock::time_point wall(std::chrono::milliseconds since) {
  return RecentStates::Clock::time_point{} + since;
}

TEST(RecentStates, AreSampledTenTimesASecond) {
  RecentStates states;
  Configuration q(1);
  for (int i = 0; i < 3000; ++i) {  // at 30 Hz
    q[0] = i;
    states.take(at(std::chrono::milliseconds(i)), q,
                wall(std::chrono::microseconds(33'333) * i / 1ms * 1ms));
  }
  EXPECT_NEAR(static_cast<double>(states.frames().size()), 1000.0, 2.0);
  EXPECT_EQ(states.frames().front()->q[0], 0);
  EXPECT_EQ(states.frames()[1]->q[0], 4) << "133 ms; 100 ms after the first there was none";
  EXPECT_EQ(states.frames()[2]->q[0], 7) << "233 ms: none is lost for it";
}

TEST(RecentStates, AreKeptForFiveMinutes) {
  RecentStates states;
  const Configuration q = Configuration::Zero(1);
  for (int i = 0; i < 3500; ++i) states.take(at(i * 100ms), q, wall(i * 100ms));
  ASSERT_EQ(states.frames().size(), RecentStates::kFramesMax);
  EXPECT_EQ(states.frames().front()->time, at(50s));
  EXPECT_EQ(states.frames().back()->time - states.frames().front()->time, 300s - 100ms);
}

TEST(RecentStates, DoNotFillAGapAfterwards) {
  RecentStates states;
  const Configuration q = Configuration::Zero(1);
  states.take(at(0s), q, wall(0ms));
  for (int i = 0; i < 10; ++i) states.take(at(10s), q, wall(10'000ms + i * 10ms));
  EXPECT_EQ(states.frames().size(), 2U) << "what was missed is not made up for";
}

TEST(RecentStates, AreGivenToWhoWaitsForLaterOnes) {
  RecentStates states;
  const Configuration q = Configuration::Zero(1);
  states.take(at(0s), q, wall(0ms));
  std::vector<std::size_t> told;
  const auto tell = [&](const std::vector<RecentStates::FramePtr>& later) {
    told.push_back(later.size());
  };
  states.when_later(at(-1s), wall(0ms), tell);
  EXPECT_EQ(told, (std::vector<std::size_t>{1})) << "at once";
  states.when_later(at(0s), wall(10s), tell);
  states.when_later(at(9s), wall(200ms), tell);
  EXPECT_EQ(told.size(), 1U);
  states.take(at(1s), q, wall(100ms));
  EXPECT_EQ(told, (std::vector<std::size_t>{1, 1})) << "the one that waits for less";
  states.take(at(2s), q, wall(200ms));
  EXPECT_EQ(told, (std::vector<std::size_t>{1, 1, 0})) << "waited long enough";
}

using Past = Durable;
TEST_F(Past, HasTheMotionOfAnEndedJob) {
  start(5);
  ASSERT_EQ(submit("swing").status, 202);
  wait_until([&] { return job("swing")["state"] == "succeeded"; });
  const json ended = job("swing");
  const json states = get("/api/v1/states").json();
  EXPECT_EQ(states["stream"], test::Listener(port()).next_of("snapshot")["stream"]);
  const json cell = get("/api/v1/cell").json();
  ASSERT_EQ(states["joints"].size(), cell["joints"].size());
  const std::string last = states["t_s"].back().dump();
  const json later = get("/api/v1/states?wait_s=10&after_s=" + last).json();
  ASSERT_FALSE(later["t_s"].empty());
  EXPECT_GT(later["t_s"].front(), states["t_s"].back()) << "only what is new";
  EXPECT_GT(get("/api/v1/states?stream=other&after_s=" + last).json()["t_s"].size(),
            states["t_s"].size());
  EXPECT_EQ(states["joints"][0], cell["joints"][0]["name"]);
  ASSERT_EQ(states["t_s"].size(), states["q"].size());
  double farthest = 0, before = -1;
  std::size_t frames = 0;
  for (std::size_t i = 0; i < states["q"].size(); ++i) {
    const double t_s = states["t_s"][i];
    EXPECT_GT(t_s, before);
    before = t_s;
    ASSERT_EQ(states["q"][i].size(), states["joints"].size());
    if (t_s < ended["started_s"] || t_s > ended["ended_s"]) continue;
    farthest = std::max(farthest, states["q"][i][0].get<double>());
    ++frames;
  }
  EXPECT_GE(frames, 2U);
  EXPECT_GT(farthest, 0.1) << "joint 1 went to 0.3 and back";
}

}  // namespace
}  // namespace armloom
