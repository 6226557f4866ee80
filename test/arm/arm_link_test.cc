// The state machine between the server and one controller, with reports made by hand.
#include "core/arm/arm_link.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "test/arm/arm_fixture.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using Phase = ArmFeedback::Phase;
using State = ArmLink::State;

// A controller that reports what the test says.
class HandController final : public ArmController {
 public:
  [[nodiscard]] const std::vector<JointId>& joints() const override { return joints_; }
  void send(const ArmCommand& command) override { sent.push_back(command); }
  [[nodiscard]] const ArmFeedback* poll(TimePoint) override {
    if (reports.empty()) return nullptr;
    last_ = std::move(reports.front());
    reports.erase(reports.begin());
    return &last_;
  }
  [[nodiscard]] ArmConnection connection() const override { return connected; }

  std::vector<ArmCommand> sent;
  std::vector<ArmFeedback> reports;
  ArmConnection connected;

 private:
  std::vector<JointId> joints_{JointId{0}, JointId{1}};
  ArmFeedback last_;
};

class Link : public ::testing::Test {
 protected:
  // Passes a cycle of 1 ms.
  void pass() { link.exchange(controller, now += 1ms); }
  void pass(Duration time) {
    for (const TimePoint end = now + time; now < end;) pass();
  }
  // A report that left the controller `delay` ago.
  void report(Phase phase = Phase::idle, Duration progress = {}, Duration delay = {}) {
    ArmFeedback feedback;
    feedback.sequence = ++sequence;
    feedback.controller_time = (now + 1ms - delay).time_since_epoch() + 17s;  // another clock
    feedback.acknowledged = acknowledged;
    feedback.phase = phase;
    feedback.measured = Eigen::VectorXd::Zero(2);
    feedback.commanded_progress = feedback.measured_progress = progress;
    feedback.settled = settled;
    controller.reports.push_back(feedback);
    pass();
  }
  void come_up() {
    report();
    ASSERT_EQ(link.state(), State::up);
  }
  void follow(Duration authority = 1s) {
    link.command(ArmCommand::Follow{trajectory, now, 0s, authority});
    link.flush(controller);
  }

  std::mt19937_64 random{1};
  CellPtr cell = two_arm_cell();
  TrajectoryPtr trajectory = random_trajectory(*cell, joints_of(*cell, kLeft), {kLeft}, random);
  ControllerDescription promises{.feedback_timeout = 100ms};
  ArmLink link{promises, Eigen::VectorXd::Zero(2)};
  HandController controller;
  TimePoint now{};
  std::uint64_t sequence = 0;
  CommandNumber acknowledged = 0;
  bool settled = false;
};

TEST_F(Link, ConnectsWithTheFirstReport) {
  pass(1s);
  EXPECT_EQ(link.state(), State::connecting);
  EXPECT_FALSE(link.detail().empty());
  report();
  EXPECT_EQ(link.state(), State::up);
  EXPECT_TRUE(link.detail().empty());
}

TEST_F(Link, BecomesStaleThenLostWithoutReports) {
  come_up();
  pass(50ms);
  EXPECT_EQ(link.state(), State::up);
  pass(1ms);
  EXPECT_EQ(link.state(), State::stale);
  pass(49ms);
  EXPECT_EQ(link.state(), State::stale);
  pass(1ms);
  EXPECT_EQ(link.state(), State::lost);
  report();
  EXPECT_EQ(link.state(), State::up);
}

TEST_F(Link, CountsAgeFromTheMeasurementNotFromTheArrival) {
  come_up();  // undelayed
  pass(10ms);
  report(Phase::idle, 0s, 60ms);
  EXPECT_EQ(link.state(), State::stale);
  EXPECT_NEAR(to_seconds(link.age()), 0.06, 0.001);
}

TEST_F(Link, IsLostAtOnceWhenTheConnectionBreaks) {
  come_up();
  controller.connected = {false, "no answer from tcp:10.0.0.7:4000", 1};
  pass();
  EXPECT_EQ(link.state(), State::lost);
  EXPECT_EQ(link.detail(), "no answer from tcp:10.0.0.7:4000");
}

TEST_F(Link, IsLostUntilTheFirstReportOfANewConnection) {
  come_up();
  controller.connected.number = 2;
  pass();
  EXPECT_EQ(link.state(), State::lost);
  sequence = 0;
  report();
  EXPECT_EQ(link.state(), State::up);
}

TEST_F(Link, IgnoresOldAndMalformedReports) {
  come_up();
  report(Phase::moving, 20ms);
  const std::uint64_t newest = sequence;
  sequence -= 2;
  report(Phase::moving, 10ms);  // overtaken by the one before
  sequence = newest;
  EXPECT_EQ(link.ignored(), 1u);
  ArmFeedback wrong;
  wrong.sequence = ++sequence;
  wrong.measured = Eigen::VectorXd::Zero(3);
  controller.reports.push_back(wrong);
  pass();
  wrong.sequence = ++sequence;
  wrong.measured = Eigen::VectorXd::Constant(2, std::numeric_limits<double>::quiet_NaN());
  controller.reports.push_back(wrong);
  pass();
  EXPECT_EQ(link.ignored(), 3u);
  EXPECT_EQ(link.feedback().measured_progress, 20ms);
}

TEST_F(Link, TreatsAMotionAsWaitingUntilItIsAcknowledged) {
  come_up();
  follow();
  ASSERT_EQ(controller.sent.size(), 1u);
  report(Phase::finished, 700ms);  // the end of a motion before
  EXPECT_EQ(link.feedback().phase, Phase::waiting);
  EXPECT_EQ(link.feedback().measured_progress, 0s);
  acknowledged = 1;
  report(Phase::moving, 10ms);
  EXPECT_EQ(link.feedback().phase, Phase::moving);
}

TEST_F(Link, IgnoresReportsOnCommandsThatWereNeverSent) {
  come_up();
  follow();
  acknowledged = 2;
  report(Phase::moving, 10ms);
  EXPECT_EQ(link.ignored(), 1u);
  EXPECT_EQ(link.feedback().phase, Phase::waiting);
}

TEST_F(Link, IsNotSettledWhileACommandIsUnderWay) {
  settled = true;
  come_up();
  EXPECT_TRUE(link.feedback().settled);
  link.command(ArmCommand::SetSpeed{0.5});
  link.flush(controller);
  EXPECT_FALSE(link.feedback().settled);
  report();
  EXPECT_FALSE(link.feedback().settled);
  acknowledged = 1;
  report();
  EXPECT_TRUE(link.feedback().settled);
}

TEST_F(Link, ReportsARejectedMotionAsAFault) {
  come_up();
  follow();
  acknowledged = 1;
  ArmFeedback refusal;
  refusal.sequence = ++sequence;
  refusal.controller_time = now.time_since_epoch() + 17s;
  refusal.acknowledged = refusal.rejected = 1;
  refusal.detail = "joint 2 is too far";
  refusal.measured = Eigen::VectorXd::Zero(2);
  controller.reports.push_back(refusal);
  pass();
  EXPECT_EQ(link.feedback().phase, Phase::fault);
  EXPECT_EQ(link.feedback().detail, "joint 2 is too far");
}

TEST_F(Link, RepeatsCommandsThatAreNotAcknowledged) {
  come_up();
  follow();
  link.command(ArmCommand::Extend{2s});
  link.flush(controller);
  ASSERT_EQ(controller.sent.size(), 2u);
  for (int i = 0; i < 49; ++i) report();
  EXPECT_EQ(controller.sent.size(), 2u);
  report();
  ASSERT_EQ(controller.sent.size(), 4u);
  EXPECT_EQ(controller.sent[2].number, 1u);
  EXPECT_EQ(controller.sent[3].number, 2u);
  acknowledged = 2;
  for (int i = 0; i < 200; ++i) report(Phase::moving, i * 1ms);
  EXPECT_EQ(controller.sent.size(), 4u);
}

TEST_F(Link, RepeatsNoCommandThatLetsTheArmMoveAfterABrake) {
  come_up();
  follow();
  link.command(ArmCommand::Extend{2s});
  link.flush(controller);
  link.command(ArmCommand::Brake{});
  link.flush(controller);
  controller.sent.clear();
  pass(51ms);
  ASSERT_EQ(controller.sent.size(), 3U);
  const auto* repeated = std::get_if<ArmCommand::Follow>(&controller.sent[0].what);
  ASSERT_NE(repeated, nullptr);
  EXPECT_EQ(repeated->authority, 0s);
  EXPECT_TRUE(std::holds_alternative<ArmCommand::Brake>(controller.sent[1].what));
  EXPECT_EQ(controller.sent[1].number, 2U);
}

TEST_F(Link, KeepsAuthorityBackWhileItIsStale) {
  come_up();
  follow();
  acknowledged = 1;
  report(Phase::moving);
  pass(60ms);
  ASSERT_EQ(link.state(), State::stale);
  const std::size_t before = controller.sent.size();
  link.command(ArmCommand::Extend{2s});
  link.command(ArmCommand::Extend{3s});
  link.flush(controller);
  pass();
  EXPECT_EQ(controller.sent.size(), before);
  report(Phase::moving, 50ms);
  ASSERT_EQ(controller.sent.size(), before + 1);
  EXPECT_EQ(std::get<ArmCommand::Extend>(controller.sent.back().what).authority, 3s);
}

TEST_F(Link, SendsABrakeAlsoWhileItIsStaleAndDropsWhatWaits) {
  come_up();
  pass(60ms);
  follow();
  link.command(ArmCommand::Brake{});
  link.flush(controller);
  ASSERT_EQ(controller.sent.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<ArmCommand::Brake>(controller.sent.front().what));
  EXPECT_EQ(link.feedback().phase, Phase::stopped);
  acknowledged = 1;
  report();
  EXPECT_EQ(link.feedback().phase, Phase::stopped) << "the motion never began";
  EXPECT_EQ(controller.sent.size(), 1u) << "the dropped motion is not sent later";
}

TEST_F(Link, KnowsSinceWhenTheControllerObeysABrake) {
  come_up();
  follow();
  acknowledged = 1;
  report(Phase::moving, 10ms);
  link.command(ArmCommand::Brake{});
  pass(60ms);
  report(Phase::moving, 70ms);
  EXPECT_FALSE(link.braking_since()) << "not acknowledged";
  acknowledged = 2;
  report(Phase::braking, 80ms);
  EXPECT_EQ(link.braking_since(), now);
  report(Phase::stopped, 90ms);
  EXPECT_EQ(link.braking_since(), now - 1ms);
  follow();
  EXPECT_FALSE(link.braking_since());
}

// The server side of "reconnecting never starts a motion".
TEST_F(Link, KnowsAnArmThatItsControllerStopped) {
  come_up();
  follow();
  acknowledged = 1;
  report(Phase::moving, 10ms);
  EXPECT_FALSE(link.stopped_by_itself());
  report(Phase::stopped, 20ms);
  EXPECT_TRUE(link.stopped_by_itself());
  link.command(ArmCommand::Brake{});
  link.flush(controller);
  EXPECT_FALSE(link.stopped_by_itself());
}

TEST_F(Link, DropsCommandsOfABrokenConnection) {
  come_up();
  follow();
  controller.connected = {false, "broken", 1};
  pass(200ms);
  controller.connected = {true, "", 2};
  controller.sent.clear();
  sequence = 0;
  report();  // the controller has not seen the motion
  EXPECT_EQ(link.state(), State::up);
  EXPECT_EQ(link.feedback().phase, Phase::fault);
  pass(40ms);
  EXPECT_TRUE(controller.sent.empty());
}

TEST_F(Link, RecognizesAMotionThatSurvivedABrokenConnection) {
  come_up();
  follow();
  controller.connected = {false, "broken", 1};
  pass(200ms);
  controller.connected = {true, "", 2};
  sequence = 0;
  acknowledged = 1;
  report(Phase::stopped, 300ms);
  EXPECT_EQ(link.feedback().phase, Phase::stopped);
  EXPECT_EQ(link.feedback().measured_progress, 300ms);
}

TEST_F(Link, ReportsAFaultIfTheControllerWasRestarted) {
  come_up();
  follow();
  acknowledged = 1;
  report(Phase::moving, 5ms);
  controller.connected = {true, "", 2};
  sequence = 0;
  acknowledged = 0;
  report(Phase::idle);
  EXPECT_EQ(link.feedback().phase, Phase::fault);
  link.command(ArmCommand::Release{});
  link.flush(controller);
  EXPECT_EQ(link.feedback().phase, Phase::idle);
  EXPECT_EQ(controller.sent.back().number, 1u) << "continues the controller's numbers";
}

// Its first reports after the restart were old ones.
TEST_F(Link, ContinuesTheNumbersOfAControllerThatForgotCommands) {
  come_up();
  follow();
  acknowledged = 1;
  report(Phase::moving, 10ms);
  acknowledged = 0;
  report(Phase::idle);
  EXPECT_EQ(link.state(), State::up);
  EXPECT_EQ(link.feedback().phase, Phase::fault);
  link.command(ArmCommand::Release{});
  controller.sent.clear();
  follow();
  ASSERT_FALSE(controller.sent.empty());
  EXPECT_EQ(controller.sent.front().number, 1U) << "the number that it expects";
}

TEST_F(Link, ReportsAFaultIfTheControllerForgetsAMotionThatItAccepted) {
  come_up();
  follow();
  acknowledged = 1;
  report(Phase::moving, 5ms);
  report(Phase::idle);
  EXPECT_EQ(link.feedback().phase, Phase::fault);
}

TEST_F(Link, CommandsTheSpeedOverrideAgainOnEachNewConnectionBeforeAnyMotion) {
  come_up();
  link.command(ArmCommand::SetSpeed{0.5});
  link.command(ArmCommand::SetSpeed{0.25});
  link.flush(controller);
  ASSERT_EQ(controller.sent.size(), 1U) << "only the last one counts";
  controller.connected = {true, "", 2};
  pass();
  controller.sent.clear();
  follow();
  report();
  ASSERT_EQ(controller.sent.size(), 2U);
  const auto* speed = std::get_if<ArmCommand::SetSpeed>(&controller.sent.front().what);
  ASSERT_NE(speed, nullptr);
  EXPECT_EQ(speed->share, 0.25);
}

TEST_F(Link, ToleratesAClockThatDriftsSlowly) {
  come_up();
  for (int i = 0; i < 100'000; ++i) {
    ArmFeedback feedback;
    feedback.sequence = ++sequence;
    // The controller's clock loses 0.05 %.
    feedback.controller_time = from_seconds(0.9995 * to_seconds(now + 1ms)) + 17s;
    feedback.measured = Eigen::VectorXd::Zero(2);
    controller.reports.push_back(feedback);
    pass();
    ASSERT_EQ(link.state(), State::up) << i;
  }
}

}  // namespace
}  // namespace armloom
