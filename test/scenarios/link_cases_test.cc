// Arms whose link to the controller is lost, and arms that are not where they came to rest.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/arm/simulated_arm.h"
#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

using LinkState = ArmLink::State;

// The controller of one slider, which can be switched off and on again at another place.
class RestartedArm final : public ArmController {
 public:
  RestartedArm(CellPtr cell, ArmId arm, const Eigen::VectorXd& q)
      : cell_(std::move(cell)), arm_(arm) {
    inner_ = std::make_unique<SimulatedArm>(cell_, arm_, q, 1);
  }
  [[nodiscard]] const std::vector<JointId>& joints() const override { return inner_->joints(); }
  void send(const ArmCommand& command) override {
    ++commands;
    last_ = command.number;
    if (connection_.is_up) inner_->send({command.number + own_brakes_, command.what});
  }
  [[nodiscard]] const ArmFeedback* poll(TimePoint now) override {
    const ArmFeedback* report = connection_.is_up ? inner_->poll(now) : nullptr;
    if (report == nullptr) return nullptr;
    report_ = *report;
    report_.acknowledged -= std::min(report_.acknowledged, own_brakes_);
    return &report_;
  }
  // Brakes without a command, as a controller does that has missed the server.
  void brake() { inner_->send({last_ + ++own_brakes_, ArmCommand::Brake{}}); }
  [[nodiscard]] ArmConnection connection() const override { return connection_; }

  void switch_off() { connection_ = {false, "switched off", connection_.number}; }
  void say_in_use() { connection_ = {false, "in use", connection_.number, true}; }
  void switch_on_at(double position_m) {
    inner_ =
        std::make_unique<SimulatedArm>(cell_, arm_, Eigen::VectorXd::Constant(1, position_m), 1);
    last_ = own_brakes_ = 0;
    connection_ = {true, "", connection_.number + 1};
  }
  int commands = 0;

 private:
  CellPtr cell_;
  ArmId arm_;
  std::unique_ptr<SimulatedArm> inner_;
  ArmConnection connection_;
  ArmFeedback report_;
  CommandNumber last_ = 0, own_brakes_ = 0;
};

// The crossing, under `certified`, with controllers that can be switched off.
struct Switched {
  std::vector<RestartedArm*> arms;
  bool are_off = false;  // at the start
  Crossing cell;

  explicit Switched(bool off = false)
      : are_off(off), cell(crossing_description(), "certified", types()) {}
  ControllerTypes types() {
    return {{"sim",
             [this](const CellPtr& made, ArmId arm, Eigen::VectorXd q,
                    std::uint64_t) -> Result<MadeController> {
               auto controller = std::make_unique<RestartedArm>(made, arm, q);
               if (are_off) controller->switch_off();
               arms.push_back(controller.get());
               return MadeController{std::move(controller)};
             }}};
  }
  Executive& executive() { return cell.simulation->executive(); }
  ArmView arm(std::size_t index) { return executive().arms()[index]; }
};

TEST(LostLink, StopsItsArmUntilItIsResumed) {
  Crossing cell(crossing_description(), "certified");
  cell.submit(slide("x", -1, 1, 4, "loses"));
  cell.submit(slide("y", -1, -0.5, 6, "unconcerned"));
  ASSERT_TRUE(cell.simulation->executive().faults().inject(
      {.arm = "x", .kind = ArmFault::Kind::drop_feedback, .at = at(1s), .lasting = 1s}));
  cell.run_until(at(1090ms));
  EXPECT_EQ(cell.simulation->executive().arms()[0].link, LinkState::stale);
  EXPECT_EQ(cell.job("loses").state, JobState::running);
  cell.run_until(at(1500ms));
  EXPECT_EQ(cell.simulation->executive().arms()[0].link, LinkState::lost);
  EXPECT_EQ(cell.simulation->executive().arms()[0].state, ArmState::stopped);
  EXPECT_EQ(cell.simulation->executive().resume({ArmId{0}}), std::vector{ArmId{0}});
  cell.run_until(at(3s));
  EXPECT_EQ(cell.simulation->executive().arms()[0].link, LinkState::up);
  const JobView lost = cell.job("loses");
  EXPECT_EQ(lost.state, JobState::paused);
  ASSERT_FALSE(lost.waits_on.empty());
  EXPECT_NE(lost.waits_on.front().detail.find("link lost"), std::string::npos);
  EXPECT_EQ(cell.job("unconcerned").state, JobState::running);
  EXPECT_TRUE(cell.simulation->executive().resume({ArmId{0}}).empty());
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("loses").state, JobState::succeeded);
  EXPECT_EQ(cell.job("unconcerned").state, JobState::succeeded);
}

// Another arm passes only where the lost arm cannot get to.
TEST(LostLink, KeepsItsAuthorityReserved) {
  Crossing cell(crossing_description(), "certified");
  cell.submit(slide("x", -1, 1, 4, "loses"));
  ASSERT_TRUE(cell.simulation->executive().faults().inject(
      {.arm = "x", .kind = ArmFault::Kind::drop_feedback, .at = at(1700ms), .lasting = 20s}));
  cell.run_until(at(2s));
  cell.submit(slide("y", -1, 1, 4, "waits"));
  cell.run_until(at(15s));
  EXPECT_FALSE(is_terminal(cell.job("waits").state));
  EXPECT_FALSE(cell.job("waits").waits_on.empty());
  cell.run_until(at(22s));
  resume_all(cell.simulation->executive());
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("waits").state, JobState::succeeded);
}

TEST(LostLink, StartsNothingWhenItIsBack) {
  Switched s;
  s.cell.submit(slide("x", -1, 1, 4, "lost"));
  s.cell.submit(slide("x", 1, -1, 4, "behind"));
  s.cell.run_until(at(1s));
  const double stood = s.arm(0).q.front();
  s.arms[0]->switch_off();
  s.cell.run_until(at(2s));
  s.arms[0]->switch_on_at(stood);
  const int before = s.arms[0]->commands;
  s.cell.run_until(at(5s));
  EXPECT_EQ(s.arm(0).q.front(), stood);
  EXPECT_EQ(s.arm(0).state, ArmState::stopped);
  EXPECT_LE(s.arms[0]->commands, before + 1) << "only the motion is released";
  EXPECT_EQ(s.cell.job("lost").state, JobState::failed) << "the controller has forgotten it";
  EXPECT_EQ(s.cell.job("lost").reason(), Reason::arm_fault);
}

TEST(LostLink, ArmThatItsControllerStoppedWaitsForAResume) {
  Switched s;
  s.cell.submit(slide("x", -1, 1, 4, "runs"));
  s.cell.run_until(at(1s));
  s.arms[0]->brake();
  s.cell.run_until(at(5s));
  EXPECT_EQ(s.arm(0).state, ArmState::stopped);
  EXPECT_EQ(s.arm(0).stop_cause, "its controller stopped the arm by itself");
  EXPECT_EQ(s.cell.job("runs").state, JobState::paused);
  const double stands = s.arm(0).q.front();
  s.cell.run_until(at(8s));
  EXPECT_EQ(s.arm(0).q.front(), stands);
  EXPECT_TRUE(s.executive().resume({ArmId{0}}).empty());
  s.cell.run_to_the_end();
  EXPECT_EQ(s.cell.job("runs").state, JobState::succeeded);
}

TEST(MovedArm, JobOnItsPathFailsWithStartMismatch) {
  Switched s;
  s.cell.submit(slide("x", -1, 1, 4, "on its path"));
  s.cell.run_until(at(1s));
  s.executive().stop({ArmId{0}}, "operator");
  s.cell.run_until(at(2s));
  ASSERT_EQ(s.cell.job("on its path").state, JobState::paused);
  s.arms[0]->switch_off();
  s.cell.run_until(at(3s));
  s.arms[0]->switch_on_at(-0.4);
  s.cell.run_until(at(4s));
  s.executive().resume({ArmId{0}});
  s.cell.run_until(at(5s));
  const JobView job = s.cell.job("on its path");
  ASSERT_EQ(job.state, JobState::failed);
  EXPECT_EQ(job.reason(), Reason::start_mismatch);
  EXPECT_NE(job.detail().find("moved while it was stopped"), std::string::npos) << job.detail();
  EXPECT_NEAR(s.arm(0).q.front(), -0.4, 1e-9);
}

TEST(MovedArm, JobRejoinsByAPlannedMotionIfItsClientWantsThat) {
  Switched s;
  JobRequest request = slide("x", -1, 1, 4, "on its path");
  request.terms.move_to_start = MoveToStart::plan;
  s.cell.submit(request);
  s.cell.run_until(at(1s));
  s.executive().stop({ArmId{0}}, "operator");
  s.cell.run_until(at(2s));
  s.arms[0]->switch_off();
  s.cell.run_until(at(3s));
  s.arms[0]->switch_on_at(-0.4);
  s.cell.run_until(at(4s));
  s.executive().resume({ArmId{0}});
  s.cell.run_to_the_end();
  EXPECT_EQ(s.cell.job("on its path").state, JobState::succeeded);
  EXPECT_NEAR(s.arm(0).q.front(), 1.0, 1e-6);
}

TEST(MovedArm, NextJobIsComparedWithWhereTheArmIs) {
  Switched s;
  s.arms[0]->switch_off();
  s.cell.run_until(at(1s));
  s.arms[0]->switch_on_at(-0.4);
  s.cell.run_until(at(2s));
  s.executive().resume({ArmId{0}});
  s.cell.run_until(at(3s));
  EXPECT_FALSE(s.executive().submit(slide("x", -1, 1, 4, "elsewhere")));
  s.cell.submit(slide("x", -0.4, 1, 4, "from there"));
  s.cell.run_to_the_end();
  EXPECT_EQ(s.cell.job("from there").state, JobState::succeeded);
}

TEST(FirstConnection, JobsWaitForItAndThenRunFromWhereTheArmIs) {
  Switched s(true);
  s.cell.submit(slide("y", -1, 1, 4, "waits"));
  s.cell.run_until(at(2s));
  EXPECT_EQ(s.arm(1).link, LinkState::connecting);
  EXPECT_EQ(s.arm(1).state, ArmState::stopped);
  const JobView waiting = s.cell.job("waits");
  ASSERT_FALSE(waiting.waits_on.empty());
  EXPECT_EQ(waiting.waits_on.front().detail, "its controller has not connected: switched off");
  s.arms[0]->switch_on_at(-0.5);
  s.arms[1]->switch_on_at(-1.0);
  s.cell.run_to_the_end();
  EXPECT_EQ(s.cell.job("waits").state, JobState::succeeded);
  EXPECT_NEAR(s.arm(0).q.front(), -0.5, 1e-9);
  s.cell.submit(slide("x", -0.5, -1, 4, "from there"));
  s.cell.run_to_the_end();
  EXPECT_EQ(s.cell.job("from there").state, JobState::succeeded);
}

// The arm that has not connected could be in the way.
TEST(FirstConnection, NoArmMovesBesideAnArmThatMayBeAnywhere) {
  Switched s(true);
  s.cell.submit(slide("y", -1, 1, 4, "waits"));
  s.arms[1]->switch_on_at(-1.0);
  s.cell.run_until(at(3s));
  EXPECT_EQ(s.arm(1).link, LinkState::up);
  EXPECT_EQ(s.arm(1).q.front(), -1.0);
  const JobView waiting = s.cell.job("waits");
  ASSERT_EQ(waiting.waits_on.size(), 1U);
  EXPECT_EQ(waiting.waits_on.front().detail,
            "the position of x is not known: its controller has not connected: switched off");
  s.arms[0]->switch_on_at(0.0);  // in the path
  s.cell.run_until(at(4s));
  EXPECT_EQ(s.arm(1).q.front(), -1.0);
  EXPECT_EQ(s.cell.job("waits").state, JobState::backlogged);
  EXPECT_EQ(s.cell.job("waits").waits_on.front().kind, Wait::Kind::arm);
}

TEST(FirstConnection, EndsNoStopOfTheOperator) {
  for (const bool stopped_before : {false, true}) {
    Switched s(true);
    s.arms[0]->switch_on_at(-1.0);
    if (stopped_before) s.executive().stop({ArmId{1}}, "operator");
    s.cell.submit(slide("y", -1, 1, 4, "waits"));
    s.cell.run_until(at(1s));
    if (!stopped_before) s.executive().stop({ArmId{1}}, "operator");
    s.cell.run_until(at(2s));
    EXPECT_EQ(s.arm(1).stop_cause, "operator");
    s.arms[1]->switch_on_at(-1.0);
    s.cell.run_until(at(5s));
    EXPECT_EQ(s.arm(1).q.front(), -1.0);
    EXPECT_EQ(s.arm(1).state, ArmState::stopped);
    EXPECT_TRUE(s.executive().resume({ArmId{1}}).empty());
    s.cell.run_until(at(10s));
    EXPECT_EQ(s.cell.job("waits").state, JobState::succeeded);
  }
}

TEST(FirstConnection, StartsNothingOnAnArmThatServedAnotherServer) {
  Switched s(true);
  s.arms[0]->switch_on_at(-1.0);
  s.cell.submit(slide("y", -1, 1, 4, "waits"));
  s.arms[1]->say_in_use();
  s.cell.run_until(at(1s));
  s.arms[1]->switch_on_at(-1.0);
  s.cell.run_until(at(5s));
  EXPECT_EQ(s.arm(1).q.front(), -1.0);
  EXPECT_EQ(s.arm(1).state, ArmState::stopped);
  EXPECT_NE(s.arm(1).stop_cause.find("another server"), std::string::npos);
  EXPECT_TRUE(s.executive().resume({ArmId{1}}).empty());
  s.cell.run_until(at(10s));
  EXPECT_EQ(s.cell.job("waits").state, JobState::succeeded);
}

// An arm that moves in real time, beside a server whose cell time slips.
class RealTimeArm final : public ArmController {
 public:
  RealTimeArm(const CellPtr& cell, ArmId arm, const Eigen::VectorXd& q) : inner_(cell, arm, q, 1) {}
  [[nodiscard]] const std::vector<JointId>& joints() const override { return inner_.joints(); }
  void send(const ArmCommand& command) override { inner_.send(command); }
  [[nodiscard]] const ArmFeedback* poll(TimePoint now) override {
    return inner_.poll(now + slipped);
  }
  Duration slipped{};  // cell time that the server lost so far

 private:
  SimulatedArm inner_;
};

TEST(BusyServer, StopsNoArmWhoseReportsItTakesAtOnce) {
  std::vector<RealTimeArm*> arms;
  const auto make = [&arms](const CellPtr& cell, ArmId arm, const Eigen::VectorXd& q,
                            std::uint64_t) -> Result<MadeController> {
    auto made = std::make_unique<RealTimeArm>(cell, arm, q);
    arms.push_back(made.get());
    return MadeController{std::move(made)};
  };
  Crossing cell(crossing_description(), "certified", {{"sim", make}});
  cell.submit(slide("x", -1, 1, 4, "runs"));
  for (const TimePoint time : {at(1s), at(1500ms), at(2s)}) {
    cell.run_until(time);
    arms[0]->slipped += 60ms;
  }
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("runs").state, JobState::succeeded);
  for (const Event& event : cell.log.events) {
    const auto* monitor = std::get_if<MonitorEvent>(&event.body);
    if (monitor != nullptr) ADD_FAILURE() << monitor->text;
  }
}

}  // namespace
}  // namespace armloom
