#include "server/messages/task_request.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>
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
constexpr int kRetryMax = 1000;
constexpr const char* kNoRetry =
    "this step cannot be tried again: give retry to a step with move_to, attach, detach or "
    "wait_io, "
    "or leave it out";

FormatPtr<std::vector<std::string>> touched_names() {
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
      field("touch", &Request::touch, touched_names(),
            "Links and objects that the object may touch until the next motion has ended, besides "
            "the hand"),
      field(
          "shared", &Request::shared, flag(),
          "The hands that hold the object keep it. From then on, their arms and this one move only "
          "together. Default: the object changes hands"),
  });
}

FormatPtr<DetachRequest> detach_format() {
  using Request = DetachRequest;
  return object<Request>({
      required("object", &Request::object, name(), "Name of an object that an arm holds"),
      field("link", &Request::link, name(),
            "Link of the hand that lets go. Default: all hands that hold the object"),
      field("touch", &Request::touch, touched_names(),
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

// The JSON form of a motion.
struct MotionBody {
  std::string name;
  std::optional<TrajectoryRequest> trajectory;
  std::optional<PlanGoal> move_to;
  std::string arm;
  std::optional<double> speed;
  std::vector<Trigger> triggers;
  std::optional<int> retry;
};
// The JSON form of an action, or of a motion of the gripper.
template <class T>
struct NamedStep {
  std::string name;
  T what{};
  std::optional<int> retry;
};

struct WaitBody {
  std::string name;
  Duration time{};
};

template <class Body>
PartPtr<Body> name_part() {
  return field("name", &Body::name, job_name_format(), "Display name");
}

template <class Body>
PartPtr<Body> retry_part() {
  return field("retry", &Body::retry, integer(0, kRetryMax),
               "How often the step is tried again after it has failed, each time 1 s later");
}

template <class Body>
PartPtr<Body> no_retry() {
  return not_served<Body>({"retry", "not-served", kNoRetry});
}

FormatPtr<MotionBody> motion_format() {
  using Body = MotionBody;
  return object<Body>({
      name_part<Body>(),
      field("trajectory", &Body::trajectory, trajectory_request_format(), "A motion"),
      field("move_to", &Body::move_to, plan_goal_format(),
            "A motion to a goal of `arm`. The path is planned with what the arm then holds"),
      field(
          "arm", &Body::arm, formats::name(),
          "With `move_to`: the arm that moves. With `trajectory`: joint names may lack the prefix "
          "of this arm's robot"),
      field("velocity_scaling_factor", &Body::speed, number({kVelocityScalingMin, 1.0}),
            "Velocity scaling of the motion; default: that of the job"),
      field("triggers", &Body::triggers,
            list(trigger_format(), {.most = kTriggersMax, .noun = "triggers"}),
            "Outputs that are set during the motion"),
      only_with("move_to", &Body::retry, retry_part<Body>()),
      exactly_one<Body>({"trajectory", "move_to"}),
  });
}

FormatPtr<WaitBody> wait_format() {
  return object<WaitBody>(
      {name_part<WaitBody>(), no_retry<WaitBody>(),
       required("wait_s", &WaitBody::time, seconds({0.0, kTimeMax_s}), "Waits for this time")});
}

// `above`: size of the pointer to the step.
MotionStepRequest motion_of(MotionBody& body, std::size_t above) {
  MotionStepRequest motion{.trajectory = {},
                           .move_to = std::move(body.move_to),
                           .arm = body.arm,
                           .speed = body.speed,
                           .triggers = {}};
  if (body.trajectory) {
    motion.trajectory = std::move(*body.trajectory);
    motion.trajectory.arm = body.arm;
    if (motion.trajectory.place) motion.trajectory.place->erase(0, above);
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
  StepFormat() {
    const Format<MotionBody> motion = *motion_format();
    kinds_.push_back({{"trajectory", "move_to"},
                      [motion](const JsonNode& node, StepRequest& out) {
                        MotionBody body;
                        motion.read(node, body);
                        out = {std::move(body.name), motion_of(body, node.pointer().size()),
                               body.retry.value_or(0)};
                      },
                      motion.schema(Way::in)});
    add("gripper", gripper_format(), false, "Moves the fingers of the gripper");
    add("attach", attach_format(), true,
        "The link carries the object from now on. The hand may touch it during the motion before");
    add("detach", detach_format(), true,
        "The object stays where it is, or in the other hand. The hand may touch it during the next "
        "motion");
    const Format<WaitBody> wait = *wait_format();
    kinds_.push_back({{"wait_s"},
                      [wait](const JsonNode& node, StepRequest& out) {
                        WaitBody body;
                        wait.read(node, body);
                        out = {std::move(body.name), WaitRequest{body.time}};
                      },
                      wait.schema(Way::in)});
    add("set_io", set_io_format(), false,
        "Sets an output. The step ends when the device has reported the value");
    add("wait_io", wait_io_format(), true, "Waits until a signal has the value");
  }
  void read(const JsonNode& node, StepRequest& out) const override {
    if (!node.is_object()) return;
    for (const Kind& kind : kinds_) {
      const auto is_given = [&](const char* key) { return node.has(key); };
      if (std::ranges::any_of(kind.keys, is_given)) return kind.read(node, out);
    }
    node.fault(ProblemKind::malformed, "missing-member",
               "a step has one of: trajectory, move_to, gripper, attach, detach, wait_s, set_io, "
               "wait_io");
  }
  void write(JsonWriter&, const StepRequest&) const override {
    throw std::logic_error("a step is never written");
  }
  Schema schema(Way) const override {
    Schema all = Schema::array();
    for (const Kind& kind : kinds_) all.push_back(kind.schema);
    return {{"oneOf", std::move(all)}};
  }

 private:
  struct Kind {
    std::vector<const char*> keys;
    std::function<void(const JsonNode&, StepRequest&)> read;
    Schema schema;
  };
  template <class T>
  void add(const char* key, const FormatPtr<T>& format, bool can_fail, const char* text) {
    using Body = NamedStep<T>;
    const Format<Body> body =
        *object<Body>({name_part<Body>(), can_fail ? retry_part<Body>() : no_retry<Body>(),
                       required(key, &Body::what, format, text)});
    kinds_.push_back({{key},
                      [body](const JsonNode& node, StepRequest& out) {
                        Body read;
                        body.read(node, read);
                        out = {std::move(read.name), std::move(read.what), read.retry.value_or(0)};
                      },
                      body.schema(Way::in)});
  }

  std::vector<Kind> kinds_;
};

}  // namespace

FormatPtr<StepRequest> step_request_format() {
  static const auto format =
      named<StepRequest>("StepRequest", "A step of a job: a motion, or an action between motions.",
                         make_format<StepFormat>());
  return format;
}

}  // namespace armloom
