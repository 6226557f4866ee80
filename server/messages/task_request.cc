#include "server/messages/task_request.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "server/codec/io_format.h"
#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/job_request.h"
#include "server/messages/plan_goal.h"
#include "server/messages/time_max.h"
#include "server/messages/trajectory_request.h"

namespace armloom {

using namespace formats;

namespace {

constexpr std::size_t kTouchMax = 100;

FormatPtr<std::vector<std::string>> touch_format() {
  return list(name(), {.most = kTouchMax, .noun = "names"});
}

FormatPtr<SetIoRequest> set_io_format() {
  using Request = SetIoRequest;
  return object<Request>({
      required("name", &Request::signal, name(), "Name of an output, or of a simulated input"),
      required("value", &Request::value, signal_value_format(), "Value to set"),
  });
}

struct Trigger {
  double at = 0.0;
  SetIoRequest set_io;
};

FormatPtr<Trigger> trigger_format() {
  return object<Trigger>({
      required("at", &Trigger::at, number({0.0, 1.0}),
               "Share of the motion's duration at which the output is set"),
      required("set_io", &Trigger::set_io, set_io_format(), "The output and its value"),
  });
}

FormatPtr<AttachRequest> attach_format() {
  using Request = AttachRequest;
  return object<Request>({
      required("object", &Request::object, name(), "Name of an object of the scene"),
      required("link", &Request::link, name(), "Link that carries the object, with its prefix"),
      field("touch", &Request::touch, touch_format(),
            "Links and objects that the object may touch until the next motion has ended, besides "
            "the hand"),
  });
}

FormatPtr<DetachRequest> detach_format() {
  using Request = DetachRequest;
  return object<Request>({
      required("object", &Request::object, name(), "Name of an object that an arm holds"),
      field("touch", &Request::touch, touch_format(),
            "Links and objects that the object may touch during the motion before, for example the "
            "table"),
  });
}

FormatPtr<GripperStepRequest> gripper_format() {
  using Request = GripperStepRequest;
  return object<Request>({
      required("arm", &Request::arm, name(), "Arm of the gripper"),
      required("width_m", &Request::width_m, number({0.0, 10.0}), "Width between the fingers"),
  });
}

FormatPtr<WaitIoRequest> wait_io_format() {
  using Request = WaitIoRequest;
  return object<Request>({
      required("name", &Request::signal, name(), "Name of an input or output"),
      required("value", &Request::value, signal_value_format(), "Value to wait for"),
      field("timeout_s", &Request::timeout, seconds({0.0, kTimeMax_s}),
            "Longest wait; the job then fails. Default: no limit"),
  });
}

// The JSON form of a step.
struct StepBody {
  std::string name;
  std::optional<TrajectoryRequest> trajectory;
  std::optional<PlanGoal> move_to;
  std::string arm;
  std::optional<double> speed;
  std::vector<Trigger> triggers;
  std::optional<GripperStepRequest> gripper;
  std::optional<AttachRequest> attach;
  std::optional<DetachRequest> detach;
  std::optional<Duration> wait;
  std::optional<SetIoRequest> set_io;
  std::optional<WaitIoRequest> wait_io;
};

FormatPtr<StepBody> body_format() {
  using Body = StepBody;
  static const auto format = named(
      "StepRequest", "A step of a job: a motion, or an action between two motions.",
      object<Body>({
          field("name", &Body::name, job_name_format(), "Display name"),
          field("trajectory", &Body::trajectory, trajectory_request_format(), "A motion"),
          field("move_to", &Body::move_to, plan_goal_format(),
                "A motion to a goal of `arm`. The path is planned with what the arm then holds"),
          field("arm", &Body::arm, formats::name(),
                "With `move_to`: the arm that moves. With `trajectory`: joint names may lack the "
                "prefix of this arm's robot"),
          field("velocity_scaling_factor", &Body::speed, number({kVelocityScalingMin, 1.0}),
                "Velocity scaling of the motion; default: that of the job"),
          field("triggers", &Body::triggers,
                list(trigger_format(), {.most = kTriggersMax, .noun = "triggers"}),
                "Outputs that are set during the motion"),
          field("gripper", &Body::gripper, gripper_format(), "A motion of the gripper"),
          field("attach", &Body::attach, attach_format(),
                "The link carries the object from now on. The hand may touch it during the motion "
                "before"),
          field("detach", &Body::detach, detach_format(),
                "The object stays where it is. The hand may touch it during the next motion"),
          field("wait_s", &Body::wait, seconds({0.0, kTimeMax_s}), "Waits for this time"),
          field("set_io", &Body::set_io, set_io_format(),
                "Sets an output. The step ends when the device has reported the value"),
          field("wait_io", &Body::wait_io, wait_io_format(), "Waits until a signal has the value"),
          exactly_one<Body>({"trajectory", "move_to", "gripper", "attach", "detach", "wait_s",
                             "set_io", "wait_io"}),
      }));
  return format;
}

MotionStepRequest motion_of(StepBody& body) {
  MotionStepRequest motion{.trajectory = {},
                           .move_to = std::move(body.move_to),
                           .arm = body.arm,
                           .speed = body.speed,
                           .triggers = {}};
  if (body.trajectory) {
    motion.trajectory = std::move(*body.trajectory);
    motion.trajectory.arm = body.arm;
    if (body.speed) slow_down(motion.trajectory, *body.speed);
  }
  for (Trigger& trigger : body.triggers) {
    motion.triggers.push_back({trigger.at, std::move(trigger.set_io.signal), trigger.set_io.value});
  }
  std::ranges::stable_sort(motion.triggers, {}, &TriggerRequest::at);
  return motion;
}

class StepFormat final : public CustomFormat<StepRequest> {
 public:
  void read(const JsonNode& node, StepRequest& out) const override {
    StepBody body;
    body_format()->read(node, body);
    const bool is_motion = body.trajectory || body.move_to;
    for (const char* key : {"arm", "velocity_scaling_factor", "triggers"}) {
      if (is_motion || !node.raw().is_object() || !node.raw().contains(key)) continue;
      node.fault(
          ProblemKind::invalid, "not-with-motion",
          std::string("\"") + key + "\" belongs to a \"trajectory\" or \"move_to\": leave it out");
    }
    out.name = std::move(body.name);
    if (body.gripper) {
      out.what = std::move(*body.gripper);
    } else if (body.attach) {
      out.what = std::move(*body.attach);
    } else if (body.detach) {
      out.what = std::move(*body.detach);
    } else if (body.wait) {
      out.what = WaitRequest{*body.wait};
    } else if (body.set_io) {
      out.what = std::move(*body.set_io);
    } else if (body.wait_io) {
      out.what = std::move(*body.wait_io);
    } else {
      out.what = motion_of(body);
    }
  }
  void write(JsonWriter&, const StepRequest&) const override {
    throw std::logic_error("a step is never written");
  }
  Schema schema(Way way) const override { return body_format()->schema(way); }
};

}  // namespace

FormatPtr<StepRequest> step_request_format() { return make_format<StepFormat>(); }

}  // namespace armloom
