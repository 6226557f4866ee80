#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// What an arm's controller says at a tick.
struct ArmFeedback {
  enum class Phase {
    idle,      // at rest, no motion
    waiting,   // a motion is accepted, its start is still to come
    moving,    // on the path
    braking,   // coming to rest on the path
    stopped,   // at rest on the path after a brake; the motion can be continued or dropped
    finished,  // the goal is reached and the arm is at rest: said until the next command
    fault,     // gave up; at rest
  };
  Phase phase = Phase::idle;
  Duration commanded_progress{};  // trajectory time that has been commanded
  Duration measured_progress{};   // trajectory time that measurement proves (lags behind)
  Eigen::VectorXd measured;       // positions of the controller's joints (see joints())
  std::string detail;             // fault: why
  // It stands: it has no motion, waits for its start, or rests on its path.
  bool at_rest = false;
  // And time alone changes nothing of it: it stands until the next command.
  bool settled = false;
};

// One arm (arm joints, then gripper joints) behind an interface that real arms can implement.
// Confined to the executive's strand. Nothing here blocks.
class ArmController {
 public:
  virtual ~ArmController() = default;

  [[nodiscard]] virtual const std::vector<JointId>& joints() const = 0;

  // Follow `trajectory` from `from_progress`, beginning at cell time `start_at` (if that has
  // passed: at the next tick), but never past `authority` (trajectory time): the controller brakes
  // by itself so that it comes to rest there. Only its own joints of the trajectory concern it.
  // Precondition: idle, stopped, finished; the arm stands at the trajectory's `from_progress`.
  virtual void start(TrajectoryPtr trajectory, TimePoint start_at, Duration from_progress,
                     Duration authority) = 0;
  // Moves the authority of the present motion, never backwards past what is already commanded.
  virtual void grant(Duration authority) = 0;
  // Category 2 stop: brake on the path within the joints' brake limits, keep the position.
  virtual void brake() = 0;
  // Drop the motion after stopped, finished or fault: the arm is idle where it stands.
  virtual void release() = 0;

  // One control cycle: advance to `now` and measure. `now` grows by the control period.
  virtual const ArmFeedback& tick(TimePoint now) = 0;
};

inline constexpr Duration kControlPeriod = std::chrono::milliseconds(1);

}  // namespace armloom
