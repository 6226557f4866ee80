// The state machine between the server and one controller, with reports made by hand.
#include "test/arm/link_fixture.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using test::Link;
using test::Phase;
using test::State;

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

}  // namespace
}  // namespace armloom
