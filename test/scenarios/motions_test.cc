// How the executive uses controller feedback. The arms of these tests report what the test
// prescribes.
#include "core/executive/motions.h"

#include <gtest/gtest.h>

#include "core/trajectory/stopping_reach.h"
#include "test/collision/small_cell.h"
#include "test/scheduler/one_joint_arms.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

class ToldArm final : public ArmController {
 public:
  explicit ToldArm(JointId joint) : joints_{joint} { says.measured = Eigen::VectorXd::Zero(1); }

  const std::vector<JointId>& joints() const override { return joints_; }
  void send(const ArmCommand& command) override {
    says.acknowledged = command.number;
    if (const auto* follow = std::get_if<ArmCommand::Follow>(&command.what)) {
      granted = follow->authority;
    } else if (const auto* extend = std::get_if<ArmCommand::Extend>(&command.what)) {
      granted = extend->authority;
    } else if (std::holds_alternative<ArmCommand::Brake>(command.what)) {
      ++brakes;
    }
  }
  const ArmFeedback* poll(TimePoint now) override {
    if (std::exchange(polled_at_, now) == now) return nullptr;
    ++says.sequence;
    says.controller_time = now.time_since_epoch();
    return &says;
  }

  ArmFeedback says;
  Duration granted{};
  int brakes = 0;

 private:
  std::optional<TimePoint> polled_at_;
  std::vector<JointId> joints_;
};

// Two arms of one joint each. A motion of one or both arms takes 4 s.
class ScriptedArms : public ::testing::Test {
 protected:
  ScriptedArms() {
    std::vector<std::unique_ptr<ArmController>> controllers;
    for (std::uint32_t arm = 0; arm < 2; ++arm) {
      auto told = std::make_unique<ToldArm>(cell->arms[arm].joints.front());
      arms.push_back(told.get());
      controllers.push_back(std::move(told));
    }
    motions = std::make_unique<Motions>(cell, std::move(controllers), cell->home());
    motions->tick_arms(TimePoint{});  // the links are up
  }
  void dispatch(const std::vector<ArmId>& of) {
    const std::vector<double> begins(of.size(), -1.0), ends(of.size(), 1.0);
    motions->dispatch({StepId{JobId{1}}, TimePoint{}, Duration{}, 4s},
                      small::sweep(*cell, of, begins, ends, 4s));
  }
  void say(std::size_t arm, Duration commanded, Duration measured) const {
    arms[arm]->says.phase = ArmFeedback::Phase::moving;
    arms[arm]->says.commanded_progress = commanded;
    arms[arm]->says.measured_progress = measured;
  }

  CellPtr cell = one_joint_arms(2);
  std::vector<ToldArm*> arms;
  std::unique_ptr<Motions> motions;
};

TEST_F(ScriptedArms, ReportMeasuredProgressOnly) {
  dispatch({ArmId{0}});
  say(0, 2s, 1900ms);
  const auto& reports = motions->tick(TimePoint{} + 1ms);
  ASSERT_EQ(reports.size(), 1U);
  EXPECT_EQ(reports.front().progress, 1900ms);
}

// Positions may be ahead of the progress that they prove.
TEST_F(ScriptedArms, DeviateFromTheStretchUpToTheCommandedProgress) {
  dispatch({ArmId{0}});
  const TrajectoryPtr motion = motions->trajectory(ArmId{0});
  Eigen::VectorXd path;
  motion->sample_positions(1970ms, path);
  arms[0]->says.measured = path;
  say(0, 2s, 1900ms);
  (void)motions->tick(TimePoint{} + 1ms);
  EXPECT_LE(motions->deviation(ArmId{0}, 1e-5), 1e-5);
  motion->sample_positions(2s, path);
  arms[0]->says.measured = path.array() + 0.01;
  (void)motions->tick(TimePoint{} + 2ms);
  EXPECT_NEAR(motions->deviation(ArmId{0}, 1e-5), 0.01, 1e-4);
  EXPECT_EQ(motions->deviation(ArmId{1}, 1e-5), 0.0);
}

TEST_F(ScriptedArms, ReportTheSlowestArmOfAMultiArmMotion) {
  dispatch({ArmId{0}, ArmId{1}});
  say(0, 2s, 1900ms);
  say(1, 1950ms, 1800ms);
  const auto& reports = motions->tick(TimePoint{} + 1ms);
  ASSERT_EQ(reports.size(), 1U);
  EXPECT_EQ(reports.front().progress, 1800ms);
}

TEST_F(ScriptedArms, WaitIfTheyGetAheadOfTheirMotion) {
  dispatch({ArmId{0}, ArmId{1}});
  say(0, 2s, 2s);
  say(1, 2s - 2 * Promises::kOutOfStepMin, 2s - 2 * Promises::kOutOfStepMin);
  (void)motions->tick(TimePoint{} + 1ms);
  EXPECT_EQ(arms[0]->granted, 2s - 2 * Promises::kOutOfStepMin);
  EXPECT_GT(arms[1]->granted, 2s - 2 * Promises::kOutOfStepMin);
}

// The second arm's feedback freezes. Its position is then unknown, but it can be ahead by a bounded
// time only.
TEST_F(ScriptedArms, GetBoundedAuthorityWithoutFeedback) {
  dispatch({ArmId{0}, ArmId{1}});
  const Duration reach = from_seconds(stopping_reach_s(
      *cell, *small::sweep(*cell, {ArmId{0}, ArmId{1}}, {-1.0, -1.0}, {1.0, 1.0}, 4s)));
  ASSERT_LT(1s + Promises::kOutOfStepMin + reach, 4s);
  for (int tick = 1; tick <= 1000; ++tick) {
    const Duration first = std::min<Duration>(tick * 1ms, 1s);
    const Duration known = std::min<Duration>(tick * 1ms, 500ms);
    say(0, first, first);
    say(1, known, known);
    (void)motions->tick(TimePoint{} + tick * 1ms);
    EXPECT_LE(arms[1]->granted, known + Promises::kOutOfStepMin + reach);
  }
  EXPECT_GT(arms[1]->granted, 500ms + reach);
}

TEST_F(ScriptedArms, AllBrakeOnBrakeAll) {
  dispatch({ArmId{0}});
  motions->brake_all();
  EXPECT_EQ(arms[0]->brakes, 1);
  EXPECT_EQ(arms[1]->brakes, 1);
}

}  // namespace
}  // namespace armloom
