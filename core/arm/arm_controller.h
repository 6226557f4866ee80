#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/model/promises.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Number of a command to one arm: 1, 2, 3, ... without gaps. 0: no command.
using CommandNumber = std::uint64_t;

// Stop categories of IEC 60204-1. They are not safety functions here.
enum class StopCategory : std::uint8_t {
  switch_off = 0,             // drives off at once; the arm leaves its path
  brake_then_switch_off = 1,  // brakes on the path, then drives off
  brake = 2,                  // brakes on the path, then holds its position
};

// A command to the controller of one arm. All times on a motion are trajectory times.
struct ArmCommand {
  // Follows the arm's own joints of `trajectory` from progress `from`, starting at cell time
  // `start_at` (at once if that has passed). The arm brakes by itself to rest at `authority` and
  // never passes it. Rejected unless the arm is idle, stopped or finished, and is within
  // execution.start_tolerance_rad of the path at `from`. Switches the drives on.
  struct Follow {
    TrajectoryPtr trajectory;
    TimePoint start_at;
    Duration from{};
    Duration authority{};
  };
  // Sets the authority of the present motion. It never falls below the progress at which a brake
  // from the commanded progress ends.
  struct Extend {
    Duration authority{};
  };
  struct Brake {
    StopCategory category = StopCategory::brake;
  };
  // Drops the motion: the arm becomes idle. Rejected while the arm moves.
  struct Release {};
  // Speed override. The rate of an arm is trajectory time per cell time; the planned rate is 1.
  // `share`: the largest permitted rate, 0 to 1, from now on and for all later motions. The rate
  // changes within the joints' limits. At 0 the arm comes to rest on its path.
  // `brake`: the share of these limits that the arm keeps with what it holds
  // (core/model/payload.h); `share` is at most its square root.
  struct SetSpeed {
    double share = 1.0;
    double brake = 1.0;
  };

  CommandNumber number = 0;
  std::variant<Release, Follow, Extend, Brake, SetSpeed> what;
};

// A controller's report on its arm.
struct ArmFeedback {
  enum class Phase {
    idle,      // at rest, no motion
    waiting,   // a motion is accepted and will start later
    moving,    // on the path
    braking,   // coming to rest on the path
    stopped,   // at rest on the path after a brake; can continue
    finished,  // at the goal and at rest, until the next command
    fault,     // the controller gave up or rejected the motion; the arm comes to rest
  };
  // Grows with each report. A report with a number that is not new is ignored.
  std::uint64_t sequence = 0;
  // Time of the measurement on the controller's own clock, which starts anywhere.
  Duration controller_time{};
  // The last command that was carried out or rejected. Commands are carried out in order of their
  // numbers; one that does not follow the last is ignored, so that it can be sent again.
  CommandNumber acknowledged = 0;
  // The last command that was rejected, with the reason in `detail`; 0 if none.
  CommandNumber rejected = 0;

  Phase phase = Phase::idle;
  Duration commanded_progress{};  // trajectory time commanded so far
  Duration measured_progress{};   // trajectory time proven by measurement (lags behind)
  // The authority of the present motion, as known to the controller.
  Duration authority{};
  // While braking: the progress at which the arm will rest; nullopt if the controller cannot tell.
  std::optional<Duration> rests_at = {};
  Eigen::VectorXd measured;  // positions of joints() (rad, m)
  std::string detail;        // reason of a fault or rejection
  bool drives_on = true;
  // True if the arm has no motion, waits for its start, or rests on its path.
  bool at_rest = false;
  // True if the arm also stays at rest, and its reports stay the same, until the next command.
  bool settled = false;
};

[[nodiscard]] constexpr const char* to_string(ArmFeedback::Phase phase) {
  switch (phase) {
    case ArmFeedback::Phase::idle:
      return "idle";
    case ArmFeedback::Phase::waiting:
      return "waiting";
    case ArmFeedback::Phase::moving:
      return "moving";
    case ArmFeedback::Phase::braking:
      return "braking";
    case ArmFeedback::Phase::stopped:
      return "stopped";
    case ArmFeedback::Phase::finished:
      return "finished";
    case ArmFeedback::Phase::fault:
      return "fault";
  }
  return nullptr;
}

// State of the connection to a controller.
struct ArmConnection {
  bool is_up = true;
  std::string detail = {};  // why it is not: "no answer from tcp:10.0.0.7:4000"
  // Counts the connections. If it grows, commands that were not acknowledged are lost.
  std::uint64_t number = 1;
  bool is_in_use = false;  // it is down, because the controller serves another server

  bool operator==(const ArmConnection&) const = default;
};

// The controller of one arm: its arm joints, then its gripper joints. A separate component:
// commands reach it later, or never; its reports arrive late, or never. The caller draws
// conclusions only from reports (ArmLink). Confined to the executive's strand. Never blocks.
class ArmController {
 public:
  virtual ~ArmController() = default;

  [[nodiscard]] virtual const std::vector<JointId>& joints() const = 0;
  virtual void send(const ArmCommand& command) = 0;
  // Returns the next report that has arrived by `now`, or null. Call it until it returns null. The
  // report stays valid until the next call. `now` never decreases.
  [[nodiscard]] virtual const ArmFeedback* poll(TimePoint now) = 0;
  [[nodiscard]] virtual ArmConnection connection() const { return {}; }
  // Positions of joints() as they really are, if the controller simulates its arm; else null. Only
  // for tests and recordings: no decision may depend on them.
  [[nodiscard]] virtual const Eigen::VectorXd* true_positions() const { return nullptr; }
};

}  // namespace armloom
