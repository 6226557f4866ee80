// An arm without a motion that moves on after a brake.
#include <random>

#include "test/monitor/watched_arm.h"

namespace armloom {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using Kind = MonitorFinding::Kind;

// An idle arm that moves, measured with noise. As the executive does, it brakes with the first
// finding.
struct Idle : Watched {
  std::vector<MonitorFinding> run(Duration time, double speed_rad_s, double noise_rad) {
    std::uniform_real_distribution<double> noise(-noise_rad, noise_rad);
    std::vector<MonitorFinding> ignored;
    for (const TimePoint end = seen.time + time; seen.time < end;) {
      truth += 0.01 * speed_rad_s;
      for (double& q : seen.measured) q = noise(random);
      seen.measured[1] += truth;
      for (const MonitorFinding& one : look()) {
        if (one.kind == Kind::stop_ignored) ignored.push_back(one);
        if (!arm().braking_since) arm().braking_since = seen.time;
        arm().is_stopped = true;
      }
    }
    return ignored;
  }
  void resume() {
    premises.resumed(kArm);
    arm().is_stopped = false;
  }
  std::mt19937 random{1};
  double truth = 0.0;
};

TEST(MovesOn, SwitchesDrivesOffIfAnArmMovesOnAfterABrake) {
  Idle w;
  const auto found = w.run(5s, 0.02, 0.0);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].stops, ElementsAre(kArm));
  EXPECT_GT(found[0].limit, 0.2) << "it has time to brake";
  EXPECT_GT(found[0].value, found[0].limit + 1.5) << "its windows";
  EXPECT_LT(found[0].value, found[0].limit + 1.7);
}

TEST(MovesOn, TellsMotionFromNoise) {
  EXPECT_THAT(Idle().run(5s, 0.3, 0.02), SizeIs(1));
  for (unsigned seed = 1; seed <= 300; ++seed) {
    Idle w;
    w.random.seed(seed);
    EXPECT_THAT(w.run(3s, 0.0, 0.02), IsEmpty()) << "seed " << seed;
    EXPECT_TRUE(w.arm().is_stopped);
  }
}

TEST(MovesOn, AcceptsAnArmThatAPersonMovesAfterItStood) {
  Idle w;
  ASSERT_THAT(w.run(50ms, 0.1, 0.0), IsEmpty());
  ASSERT_TRUE(w.arm().is_stopped);
  EXPECT_THAT(w.run(1500ms, 0.0, 0.0), IsEmpty());
  EXPECT_THAT(w.run(10s, 0.1, 0.0), IsEmpty());
}

TEST(MovesOn, AcceptsAnArmThatAPersonMovesWhileItIsStopped) {
  Idle w;
  w.arm().is_stopped = true;
  EXPECT_THAT(w.run(10s, 0.1, 0.0), IsEmpty());
}

TEST(MovesOn, BeginsAnewAfterAResume) {
  Idle w;
  ASSERT_THAT(w.run(10s, 0.02, 0.0), SizeIs(1));
  w.resume();
  EXPECT_THAT(w.run(10s, 0.02, 0.0), SizeIs(1));
}

TEST(MovesOn, WaitsForEnoughReports) {
  MovesOn moves;
  const std::vector<JointId> joints{JointId{0}};
  moves.begin(at(0s));
  int reports = 0;
  TimePoint now{};
  do {
    now += 100ms;
    ASSERT_LE(++reports, 100);
  } while (!moves.observe(Configuration::Constant(1, to_seconds(now)), joints, 0.001, now));
  EXPECT_EQ(reports, 5 * MovesOn::kReports);
}

}  // namespace
}  // namespace armloom
