// A link whose connection breaks, or whose controller is restarted or has another clock.
#include "test/arm/link_fixture.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using test::Link;
using test::Phase;
using test::State;

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
