// Each kind of fault of a simulated arm and of its link, seen through the contract.
#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

#include "core/arm/arm_link.h"
#include "core/arm/faulty_link.h"
#include "test/arm/arm_fixture.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using Kind = ArmFault::Kind;
using Phase = ArmFeedback::Phase;

// An arm behind its link, which follows a path with half of the authority.
struct FaultyBench {
  explicit FaultyBench(std::uint64_t seed = 1, CellOptions options = {})
      : cell(two_arm_cell(options)),
        random(7),
        path(random_trajectory(*cell, joints_of(*cell, kLeft), {kLeft}, random)),
        arm(std::make_unique<FaultyArm>(
                std::make_unique<SimulatedArm>(cell, kLeft, at_start(*path, *cell, kLeft), seed),
                seed),
            seed),
        command(arm),
        half(path->duration() / 2) {}

  void inject(Kind kind, double value = 0.0, std::optional<Duration> lasts = {}) {
    arm.inject(++id, {.kind = kind,
                      .from = now,
                      .until = lasts ? std::optional(now + *lasts) : std::nullopt,
                      .value = value});
  }
  void follow() { command.start(path, now, {}, half); }
  void run(Duration time) {
    for (const TimePoint end = now + time; now < end;) {
      now += kControlPeriod;
      while (const ArmFeedback* report = arm.poll(now)) {
        last = *report;
        ++reports;
      }
    }
  }
  [[nodiscard]] double off_path() const {
    Eigen::VectorXd q;
    path->sample_positions(last.measured_progress, q);
    return (truth().head(7) - q).cwiseAbs().maxCoeff();
  }
  [[nodiscard]] const Eigen::VectorXd& truth() const { return *arm.true_positions(); }

  CellPtr cell;
  std::mt19937_64 random;
  TrajectoryPtr path;
  FaultyLink arm;
  Commander command;
  Duration half;
  TimePoint now{};
  ArmFeedback last;
  int reports = 0;
  std::uint64_t id = 0;
};

TEST(FaultyArm, FreezesTheContentOfReportsButNotTheirNumbers) {
  FaultyBench bench;
  bench.follow();
  bench.run(bench.half / 4);
  const ArmFeedback before = bench.last;
  bench.inject(Kind::freeze_feedback, 0.0, 100ms);
  bench.run(99ms);
  EXPECT_EQ(bench.last.sequence, before.sequence + 99);
  EXPECT_EQ(bench.last.controller_time, bench.now.time_since_epoch());
  EXPECT_EQ(bench.last.measured, before.measured);
  EXPECT_EQ(bench.last.measured_progress, before.measured_progress);
  EXPECT_NE(bench.truth(), before.measured) << "the arm went on";
  bench.run(2ms);
  EXPECT_EQ(bench.last.measured, bench.truth());
}

TEST(FaultyArm, DriftsOffItsPathUntilABrake) {
  FaultyBench bench;
  bench.inject(Kind::drift, 0.5);
  bench.follow();
  bench.run(100ms);
  EXPECT_NEAR(bench.off_path(), 0.05, 0.001);
  EXPECT_EQ(bench.last.measured, bench.truth()) << "encoders tell the truth";
  bench.command.brake();
  bench.run(1s);
  EXPECT_EQ(bench.last.phase, Phase::stopped);
  EXPECT_NEAR(bench.off_path(), 0.05, 0.002);
  EXPECT_TRUE(bench.last.settled);
}

TEST(FaultyArm, DriftsFromWhereItRestsWithoutAMotion) {
  FaultyBench bench;
  bench.run(1ms);
  const double before = bench.truth()[0];
  bench.inject(Kind::drift, -1.0, 20ms);
  bench.run(10ms);
  EXPECT_FALSE(bench.last.at_rest);
  EXPECT_FALSE(bench.last.settled);
  bench.run(40ms);
  EXPECT_NEAR(bench.truth()[0], before - 0.02, 0.0011);
  EXPECT_TRUE(bench.last.settled);
  bench.follow();
  bench.run(5ms);
  EXPECT_EQ(bench.last.phase, Phase::fault) << "farther off than start_tolerance_rad";
  EXPECT_EQ(bench.last.rejected, 1U);
}

TEST(FaultyArm, RejectsOneMotion) {
  FaultyBench bench;
  bench.inject(Kind::reject);
  bench.follow();
  bench.run(5ms);
  EXPECT_EQ(bench.last.phase, Phase::fault);
  EXPECT_EQ(bench.last.acknowledged, 1U);
  EXPECT_EQ(bench.last.rejected, 1U);
  bench.command.release();
  bench.follow();
  bench.run(5ms);
  EXPECT_EQ(bench.last.phase, Phase::moving);
}

TEST(FaultyArm, StandsOnItsPathWhileItStalls) {
  FaultyBench bench;
  bench.follow();
  bench.run(bench.half / 4);
  bench.inject(Kind::stall);
  bench.run(1s);
  const Duration stands_at = bench.last.measured_progress;
  EXPECT_GT(stands_at, 0s);
  EXPECT_LT(stands_at, bench.half);
  bench.run(bench.half);
  EXPECT_EQ(bench.last.measured_progress, stands_at);
  ASSERT_TRUE(bench.arm.remove(bench.id));
  bench.run(bench.half + 1s);
  EXPECT_EQ(bench.last.measured_progress, bench.half);
}

TEST(FaultyArm, RunsAwayPastItsAuthorityUnlessItBrakes) {
  FaultyBench bench;
  bench.inject(Kind::runaway);
  bench.follow();
  bench.run(bench.half + 100ms);
  bench.command.grant(bench.half);
  bench.run(1ms);
  EXPECT_GT(bench.last.measured_progress, bench.half);
  EXPECT_EQ(bench.last.authority, bench.half) << "as acknowledged";
  bench.command.brake();
  bench.run(1s);
  EXPECT_EQ(bench.last.phase, Phase::stopped);
  EXPECT_LT(bench.last.measured_progress, bench.path->duration());

  FaultyBench other;
  other.inject(Kind::runaway);
  other.follow();
  other.run(other.path->duration() + 1s);
  EXPECT_EQ(other.last.phase, Phase::finished);
}

TEST(FaultyArm, IgnoresABrakeUntilTheFaultEnds) {
  FaultyBench bench;
  bench.inject(Kind::ignore_stop);
  bench.follow();
  bench.run(bench.half / 4);
  bench.command.brake();
  bench.run(bench.half / 4);
  EXPECT_EQ(bench.last.acknowledged, 2U);
  EXPECT_EQ(bench.last.phase, Phase::moving);
  ASSERT_TRUE(bench.arm.remove(bench.id));
  bench.run(1s);
  EXPECT_EQ(bench.last.phase, Phase::stopped);
  EXPECT_LT(bench.last.measured_progress, bench.half);
}

TEST(FaultyArm, SwitchesItsDrivesOffEvenIfItIgnoresBrakes) {
  FaultyBench bench;
  bench.inject(Kind::ignore_stop);
  bench.follow();
  bench.run(bench.half / 4);
  bench.command.brake(StopCategory::switch_off);
  bench.run(1s);
  EXPECT_FALSE(bench.last.drives_on);
  EXPECT_TRUE(bench.last.at_rest);
  EXPECT_LT(bench.last.measured_progress, bench.half);
}

TEST(FaultyArm, MeasuresNoiseThatItsTruePositionsDoNotHave) {
  FaultyBench bench;
  bench.inject(Kind::noise, 0.01);
  bench.follow();
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < 200; ++i) {
    bench.run(1ms);
    EXPECT_LT(bench.off_path(), 1e-12);
    const Eigen::VectorXd noise = bench.last.measured - bench.truth();
    sum += noise.squaredNorm();
    count += static_cast<int>(noise.size());
  }
  EXPECT_NEAR(std::sqrt(sum / count), 0.01, 0.001);
}

TEST(FaultyLink, PassesEverythingOnAtOnceWithoutFaults) {
  FaultyBench bench;
  bench.follow();
  bench.run(bench.half);
  EXPECT_EQ(bench.reports, bench.half / kControlPeriod + 1);
  EXPECT_EQ(bench.last.controller_time, bench.now.time_since_epoch());
  EXPECT_EQ(bench.last.acknowledged, 1U);
}

TEST(FaultyLink, DelaysCommandsAndReports) {
  FaultyBench bench;
  bench.inject(Kind::delay, 0.05);
  bench.follow();
  bench.run(99ms);
  EXPECT_EQ(bench.last.acknowledged, 0U);
  EXPECT_NE(bench.truth(), at_start(*bench.path, *bench.cell, kLeft)) << "the arm moves already";
  bench.run(2ms);
  EXPECT_EQ(bench.last.acknowledged, 1U);
  EXPECT_EQ(bench.last.controller_time, bench.now.time_since_epoch() - 50ms);
}

TEST(FaultyLink, KeepsTheOrderOfMessagesInJitter) {
  FaultyBench bench;
  bench.inject(Kind::jitter, 0.02);
  bench.follow();
  std::uint64_t before = 0;
  Duration latest{};
  for (int i = 0; i < 500; ++i) {
    bench.run(1ms);
    EXPECT_GE(bench.last.sequence, before);
    before = bench.last.sequence;
    latest = std::max(latest, bench.now.time_since_epoch() - bench.last.controller_time);
  }
  EXPECT_GT(latest, 10ms);
  EXPECT_LE(latest, 22ms);
}

TEST(FaultyLink, LosesMessagesWithTheGivenProbability) {
  FaultyBench bench;
  bench.inject(Kind::loss, 0.3);
  bench.run(2s);
  EXPECT_NEAR(bench.reports, 1400, 80);
}

TEST(FaultyLink, LetsLaterMessagesOvertake) {
  FaultyBench bench;
  bench.inject(Kind::reorder, 0.2);
  int overtaken = 0;
  std::uint64_t highest = 0;
  for (int i = 0; i < 1000; ++i) {
    bench.now += kControlPeriod;
    while (const ArmFeedback* report = bench.arm.poll(bench.now)) {
      if (report->sequence < highest) ++overtaken;
      highest = std::max(highest, report->sequence);
    }
  }
  EXPECT_NEAR(overtaken, 200, 50);
}

TEST(FaultyLink, BrakesTheArmWhileTheConnectionIsCut) {
  FaultyBench bench;
  bench.follow();
  bench.run(bench.half / 4);
  const int before = bench.reports;
  bench.inject(Kind::cut, 0.0, 1s);
  bench.run(999ms);
  EXPECT_LE(bench.reports, before + 1);
  EXPECT_FALSE(bench.arm.connection().is_up);
  bench.command.grant(bench.path->duration());  // lost
  bench.run(3ms);
  EXPECT_TRUE(bench.arm.connection().is_up);
  EXPECT_EQ(bench.arm.connection().number, 2U);
  EXPECT_EQ(bench.last.phase, Phase::stopped);
  EXPECT_EQ(bench.last.acknowledged, 1U);
  EXPECT_LT(bench.last.measured_progress, bench.half);
}

TEST(FaultyLink, ForgetsItsMotionWhenTheControllerRestarts) {
  FaultyBench bench;
  bench.follow();
  bench.run(bench.half / 4);
  bench.inject(Kind::restart, 0.0, 10ms);
  bench.run(1s);
  EXPECT_EQ(bench.arm.connection().number, 2U);
  EXPECT_EQ(bench.last.phase, Phase::idle);
  EXPECT_EQ(bench.last.acknowledged, 0U);
  EXPECT_LT(bench.last.sequence, 1000U);
  EXPECT_LT(bench.last.controller_time, 1s);
  EXPECT_NE(bench.truth(), at_start(*bench.path, *bench.cell, kLeft)) << "the arm stands";
  EXPECT_TRUE(bench.last.at_rest);
}

TEST(FaultyLink, LetsTheClockOfTheControllerDrift) {
  FaultyBench bench;
  bench.inject(Kind::clock_drift, -0.001);
  bench.run(2s);
  EXPECT_EQ(bench.now.time_since_epoch() - bench.last.controller_time, 2ms);
}

// All faults of the link at once: ArmLink still carries out a motion, and the same seed gives the
// same run.
TEST(FaultyLink, RepeatsForASeedAndCarriesOutMotionsUnderAllFaults) {
  const auto run = [](std::uint64_t seed) {
    FaultyBench bench(seed);
    for (const auto& [kind, value] : std::map<Kind, double>{{Kind::delay, 0.003},
                                                            {Kind::jitter, 0.005},
                                                            {Kind::loss, 0.3},
                                                            {Kind::reorder, 0.2},
                                                            {Kind::clock_drift, 0.0005},
                                                            {Kind::noise, 0.001}}) {
      bench.inject(kind, value);
    }
    ArmLink link(bench.cell->robots[0].controller, at_start(*bench.path, *bench.cell, kLeft));
    link.command(ArmCommand::Follow{bench.path, bench.now, {}, bench.path->duration()});
    std::vector<double> seen;
    for (int i = 0; i < 20'000 && link.feedback().phase != Phase::finished; ++i) {
      bench.now += kControlPeriod;
      link.exchange(bench.arm, bench.now);
      seen.push_back(link.feedback().measured[0]);
    }
    EXPECT_EQ(link.feedback().phase, Phase::finished);
    return seen;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

}  // namespace
}  // namespace armloom
