#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

struct ArmFeedback {
  enum class Phase {
    idle,      // at rest, no motion
    waiting,   // a motion is accepted and will start later
    moving,    // on the path
    braking,   // coming to rest on the path
    stopped,   // at rest on the path after a brake; can continue
    finished,  // at the goal and at rest, until the next command
    fault,     // the controller gave up; the arm is at rest
  };
  Phase phase = Phase::idle;
  Duration commanded_progress{};  // trajectory time commanded so far
  Duration measured_progress{};   // trajectory time proven by measurement (lags behind)
  // While braking: the progress at which the arm will rest; nullopt if the controller cannot tell.
  std::optional<Duration> rests_at = {};
  Eigen::VectorXd measured;  // positions of joints()
  std::string detail;        // reason of a fault
  // True if the arm has no motion, waits for its start, or rests on its path.
  bool at_rest = false;
  // True if the arm also stays at rest until the next command.
  bool settled = false;
};

// Controls one arm: its arm joints, then its gripper joints. Drivers of real arms implement this
// interface too. Confined to the executive's strand. Never blocks.
class ArmController {
 public:
  virtual ~ArmController() = default;

  [[nodiscard]] virtual const std::vector<JointId>& joints() const = 0;

  // Follows its own joints of `trajectory` from `from_progress`, starting at cell time `start_at`
  // (at the next tick if that has passed). Brakes by itself to rest at `authority` (trajectory
  // time) and never passes it. Precondition: idle, stopped or finished; the arm is at
  // `from_progress`.
  virtual void start(TrajectoryPtr trajectory, TimePoint start_at, Duration from_progress,
                     Duration authority) = 0;
  // Sets the authority of the present motion. It never moves back beyond the progress already
  // commanded.
  virtual void grant(Duration authority) = 0;
  // Category 2 stop: brakes on the path within the joints' brake limits, then keeps the position.
  virtual void brake() = 0;
  // Drops the motion, so that the arm becomes idle. Precondition: stopped, finished or fault.
  virtual void release() = 0;

  // Runs one control cycle up to `now`, which grows by the control period.
  virtual const ArmFeedback& tick(TimePoint now) = 0;
};

inline constexpr Duration kControlPeriod = std::chrono::milliseconds(1);

}  // namespace armloom
