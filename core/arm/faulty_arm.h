#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "core/arm/arm_controller.h"

namespace armloom {

// What goes wrong with a simulated arm, and when.
struct ArmFault {
  enum class Kind {
    stall,          // stays where it is on its path, then goes on
    slow,           // follows its path at `value` (0..1) of its speed
    late_start,     // begins each motion `value` seconds late
    drop_feedback,  // nothing is heard of it but that it takes commands: what it told last is told
    fault,  // the controller gives up: brakes, and reports a fault; once. It strikes the motion
            // that moves then; an arm that does not move keeps it for its next motion
  };
  Kind kind;
  TimePoint from;
  std::optional<TimePoint> until;  // absent: until removed
  double value = 0.0;
};

// A controller with faults, for tests and simulation. It does to the inner controller only what an
// executive could: it withholds authority (stall, slow), starts late, brakes; so limits and path
// are kept whatever is injected. Deterministic.
class FaultyArm final : public ArmController {
 public:
  explicit FaultyArm(std::unique_ptr<ArmController> inner);

  // `id` is the caller's, and not in use.
  void inject(std::uint64_t id, ArmFault fault);
  // False: no such fault.
  bool remove(std::uint64_t id);

  [[nodiscard]] const std::vector<JointId>& joints() const override { return inner_->joints(); }
  void start(TrajectoryPtr trajectory, TimePoint start_at, Duration from_progress,
             Duration authority) override;
  void grant(Duration authority) override;
  void brake() override;
  void release() override;
  const ArmFeedback& tick(TimePoint now) override;

 private:
  [[nodiscard]] const ArmFault* active(ArmFault::Kind kind) const;
  const ArmFeedback& advance(TimePoint now);
  void withhold(Duration period);
  void give_up();
  [[nodiscard]] bool fault_changes() const;

  std::unique_ptr<ArmController> inner_;
  std::map<std::uint64_t, ArmFault> faults_;
  TimePoint now_{};
  bool under_way_ = false;
  Duration granted_{};             // by the caller
  Duration allowed_{};             // handed on
  std::optional<double> creep_s_;  // while slow: authority that grows with the clock
  bool giving_up_ = false;
  ArmFeedback::Phase phase_ = ArmFeedback::Phase::idle;  // as told last
  ArmFeedback feedback_;
  bool dropping_ = false;
  ArmFeedback told_;  // while it is dropping
};

}  // namespace armloom
