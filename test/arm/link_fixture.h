#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "core/arm/arm_link.h"
#include "test/arm/arm_fixture.h"

namespace armloom::test {

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

}  // namespace armloom::test
