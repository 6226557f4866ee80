#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "core/arm/arm_controller.h"

namespace armloom {

struct ArmFault {
  enum class Kind {
    stall,       // stops on its path, then continues
    slow,        // follows its path at `value` (0..1) of its speed
    late_start,  // starts each motion `value` seconds late
    // Commands are still acknowledged, but the feedback is frozen at its last value.
    drop_feedback,
    // The controller gives up once: brakes and reports a fault, in the present or next motion.
    fault,
  };
  Kind kind;
  TimePoint from;
  std::optional<TimePoint> until;  // unlimited if nullopt
  double value = 0.0;
};

// A controller with faults, for tests and simulation. Acts on the inner controller only as an
// executive could (withholds authority, starts late, brakes), so limits and path are always kept.
// Deterministic.
class FaultyArm final : public ArmController {
 public:
  explicit FaultyArm(std::unique_ptr<ArmController> inner);

  // Adds a fault under an unused `id`.
  void inject(std::uint64_t id, ArmFault fault);
  // Returns false if there is no such fault.
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
  Duration granted_{};  // authority granted by the caller
  Duration allowed_{};  // authority passed on to the inner controller
  // During a `slow` fault: authority (s) that it grants, growing with time.
  std::optional<double> creep_s_;
  bool giving_up_ = false;
  ArmFeedback::Phase phase_ = ArmFeedback::Phase::idle;  // last reported by advance()
  ArmFeedback feedback_;
  bool dropping_ = false;
  ArmFeedback told_;  // feedback reported during a `drop_feedback` fault
};

}  // namespace armloom
