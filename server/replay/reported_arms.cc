#include "server/replay/reported_arms.h"

#include <stdexcept>

namespace armloom {
namespace {

std::uint64_t cycles_before(TimePoint now) {
  return static_cast<std::uint64_t>(now.time_since_epoch() / kControlPeriod);
}

class RecordedArm final : public ArmController {
 public:
  RecordedArm(std::unique_ptr<ArmController> inner, std::string name, InputLog& inputs)
      : inner_(std::move(inner)), name_(std::move(name)), inputs_(inputs) {}

  [[nodiscard]] const std::vector<JointId>& joints() const override { return inner_->joints(); }
  void send(const ArmCommand& command) override { inner_->send(command); }
  [[nodiscard]] ArmConnection connection() const override { return inner_->connection(); }
  [[nodiscard]] const ArmFeedback* poll(TimePoint now) override {
    const ArmConnection before = inner_->connection();
    const ArmFeedback* report = inner_->poll(now);
    if (report != nullptr) {
      inputs_.came(cycles_before(now), {ExecutiveInput::Reported{name_, *report}});
      return report;
    }
    ArmConnection after = inner_->connection();
    if (after != before) {
      inputs_.came(cycles_before(now), {ExecutiveInput::Connected{name_, std::move(after)}});
    }
    return nullptr;
  }

 private:
  std::unique_ptr<ArmController> inner_;
  std::string name_;
  InputLog& inputs_;
};

}  // namespace

ControllerTypes recorded(ControllerTypes types, InputLog& inputs) {
  for (auto& [type, make] : types) {
    make = [make, &inputs](const CellPtr& cell, ArmId arm, Eigen::VectorXd q,
                           std::uint64_t seed) -> Result<MadeController> {
      auto made = make(cell, arm, std::move(q), seed);
      if (!made) return made;
      return MadeController{
          std::make_unique<RecordedArm>(std::move(made->controller), cell->arm(arm).name, inputs)};
    };
  }
  return types;
}

class ReportedArms::Arm final : public ArmController {
 public:
  Arm(std::vector<JointId> joints, std::string endpoint, std::shared_ptr<std::deque<Event>> events)
      : joints_(std::move(joints)),
        connection_{false, "no answer yet from " + endpoint, 0},
        events_(std::move(events)) {}

  [[nodiscard]] const std::vector<JointId>& joints() const override { return joints_; }
  void send(const ArmCommand&) override {}
  [[nodiscard]] ArmConnection connection() const override { return connection_; }
  [[nodiscard]] const ArmFeedback* poll(TimePoint) override {
    if (events_->empty()) return nullptr;
    Event event = std::move(events_->front());
    events_->pop_front();
    if (auto* connection = std::get_if<ArmConnection>(&event)) {
      connection_ = std::move(*connection);
      return nullptr;
    }
    feedback_ = std::move(std::get<ArmFeedback>(event));
    return &feedback_;
  }

 private:
  std::vector<JointId> joints_;
  ArmConnection connection_;
  std::shared_ptr<std::deque<Event>> events_;
  ArmFeedback feedback_;
};

ControllerTypes ReportedArms::controllers() {
  const auto make = [this](const CellPtr& cell, ArmId id, const Eigen::VectorXd&,
                           std::uint64_t) -> Result<MadeController> {
    const armloom::Arm& arm = cell->arm(id);
    std::vector<JointId> joints = arm.joints;
    joints.insert(joints.end(), arm.gripper_joints.begin(), arm.gripper_joints.end());
    auto& events = events_[arm.name] = std::make_shared<std::deque<Event>>();
    return MadeController{std::make_unique<ReportedArms::Arm>(
        std::move(joints), cell->robots[arm.robot.index()].controller.endpoint, events)};
  };
  return {{"remote", make}};
}

void ReportedArms::add(const std::string& arm, Event event) {
  const auto events = events_.find(arm);
  if (events == events_.end()) {
    throw std::invalid_argument("the cell has no remote arm \"" + arm + "\"");
  }
  events->second->push_back(std::move(event));
}

void ReportedArms::add(const ExecutiveInput::Reported& in) { add(in.arm, in.feedback); }
void ReportedArms::add(const ExecutiveInput::Connected& in) { add(in.arm, in.connection); }

}  // namespace armloom
