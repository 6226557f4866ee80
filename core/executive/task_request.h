#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/time.h"
#include "core/model/io_description.h"
#include "core/planning/plan_goal.h"
#include "core/trajectory/validate.h"

namespace armloom {

// The steps of a job, as a client asks for them. server/messages/task_request.h defines the JSON.

// Sets an output while a motion is under way, once it has come to this share of its duration.
struct TriggerRequest {
  double at = 0.0;  // 0 to 1
  std::string signal;
  SignalValue value;
};
// A client's request for a motion, before it becomes a step of the scheduler.
struct MotionStepRequest {
  TrajectoryRequest trajectory;          // ignored if there is a goal
  std::optional<PlanGoal> move_to = {};  // for `arm`
  std::string arm = {};
  std::optional<double> speed = {};
  std::vector<TriggerRequest> triggers = {};
};
// The width between the fingers of an arm's gripper (m).
struct GripperStepRequest {
  std::string arm;
  double width_m = 0.0;
};
// The link carries the object from now on. `touch`: links and objects that the object may touch
// until the next motion of the arm has ended, besides the hand. `shared`: the hands that hold the
// object keep it. From then on, their arms move only together.
struct AttachRequest {
  std::string object, link;
  std::vector<std::string> touch = {};
  bool shared = false;
};
// The object stays where it is, or in the other hand. `link`: lets go; if empty, all hands do.
// `touch`: links and objects that it may touch during the motion before.
struct DetachRequest {
  std::string object;
  std::vector<std::string> touch = {};
  std::string link = {};
};
struct WaitRequest {
  Duration time{};
};
struct SetIoRequest {
  std::string signal;
  SignalValue value;
};
struct WaitIoRequest {
  std::string signal;
  SignalValue value;
  std::optional<Duration> timeout = {};
};

struct StepRequest {
  std::string name;  // may be empty
  std::variant<MotionStepRequest, GripperStepRequest, AttachRequest, DetachRequest, WaitRequest,
               SetIoRequest, WaitIoRequest>
      what;
  // How often the step is tried again if it fails. Motions to a goal: if no path is found.
  int retry = 0;

  [[nodiscard]] bool is_motion() const { return what.index() <= 1; }
};
// The pause between two tries of a step, in cell time.
inline constexpr Duration kRetryPause = std::chrono::seconds(1);

// Returns "trajectory", "move_to", "gripper", "attach", ...: the member that names the step.
[[nodiscard]] const char* kind_of(const StepRequest& step);

}  // namespace armloom
