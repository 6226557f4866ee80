#include "server/messages/trajectory_request.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

namespace {

// A ROS time: {"sec", "nanosec"} in ROS 2, {"secs", "nsecs"} in ROS 1.
struct RosTime {
  int seconds = 0;
  int nanoseconds = 0;
};
FormatPtr<RosTime> ros_time(const std::string& seconds_key, const std::string& rest_key) {
  using Limits = std::numeric_limits<std::int32_t>;
  return object<RosTime>({
      required(seconds_key, &RosTime::seconds, integer(Limits::min(), Limits::max()), ""),
      required(rest_key, &RosTime::nanoseconds, integer(0, 999'999'999), ""),
  });
}

class TimeFormat final : public CustomFormat<double> {
 public:
  void read(const JsonNode& node, double& seconds) const override {
    if (node.raw().is_number()) return seconds_->read(node, seconds);
    if (!node.raw().is_object()) {
      return node.fault(
          ProblemKind::malformed, "wrong-type",
          std::string("expected {\"sec\", \"nanosec\"} or a number of seconds, found ") +
              node.raw().type_name());
    }
    RosTime time;
    (node.has("secs") || node.has("nsecs") ? ros1_ : ros2_)->read(node, time);
    seconds = static_cast<double>(time.seconds) + static_cast<double>(time.nanoseconds) * 1e-9;
  }
  void write(JsonWriter& out, const double& seconds) const override { out.value(seconds); }
  Schema schema(Way way) const override {
    return {
        {"oneOf", Schema::array({seconds_->schema(way), ros2_->schema(way), ros1_->schema(way)})}};
  }

 private:
  FormatPtr<double> seconds_ = number(kAnyNumber);
  FormatPtr<RosTime> ros2_ = ros_time("sec", "nanosec");
  FormatPtr<RosTime> ros1_ = ros_time("secs", "nsecs");
};

}  // namespace

FormatPtr<double> time_format() {
  return named<double>("Time", "A ROS 2 time, a ROS 1 time, or a number of seconds.",
                       make_format<TimeFormat>());
}

namespace {

// Accepts what asks for no effort: an empty list, or zeros.
class NoEffort final : public CustomFormat<Anything> {
 public:
  void read(const JsonNode& node, Anything&) const override {
    node.each([](const JsonNode& n) {
      double value = 0.0;
      if (n.read(value) && value != 0.0) {
        n.invalid("not-served", "efforts are not executed: leave out \"effort\"");
      }
    });
  }
  void write(JsonWriter& out, const Anything&) const override { out.value(nullptr); }
  Schema schema(Way) const override {
    return {{"type", "array"}, {"items", {{"type", "number"}, {"const", 0}}}};
  }
};

FormatPtr<WaypointRequest> waypoint_format() {
  using Point = WaypointRequest;
  return named(
      "Waypoint", "",
      object<Point>({
          required("positions", &Point::positions, number_list(),
                   "Joint positions in the order of `joint_names`: rad or m"),
          field("velocities", &Point::velocities, number_list(),
                "Joint velocities; required unless the job has `retime`, because the motion must "
                "begin and end at rest. The first and last waypoint may leave out zeros"),
          field("accelerations", &Point::accelerations, number_list(),
                "Joint accelerations, in all waypoints (quintic splines) or in none (cubic)"),
          ignored<Point>("effort", make_format<NoEffort>(), "Empty or zero"),
          field("time_from_start", &Point::time_from_start_s, time_format(),
                "Time from the start; required unless the job has `retime`. If the first is above "
                "0, the motion begins where the arm will be"),
      }));
}

// Accepts only the time 0. `why`: the sentence for any other time.
class NoTime final : public CustomFormat<Anything> {
 public:
  explicit NoTime(const char* why) : why_(why) {}
  void read(const JsonNode& node, Anything&) const override {
    double time_s = 0.0;
    time_->read(node, time_s);
    if (time_s != 0.0) node.invalid("not-served", why_);
  }
  void write(JsonWriter& out, const Anything&) const override { out.value(nullptr); }
  Schema schema(Way) const override {
    const Schema zero{{"const", 0}};
    const auto zeros = [&](const char* seconds, const char* rest) {
      return Schema{{"type", "object"},
                    {"additionalProperties", false},
                    {"required", {seconds, rest}},
                    {"properties", {{seconds, zero}, {rest, zero}}}};
    };
    return {{"oneOf", Schema::array({zero, zeros("sec", "nanosec"), zeros("secs", "nsecs")})}};
  }

 private:
  const char* why_;
  FormatPtr<double> time_ = time_format();
};

constexpr const char* kNoStamp =
    "a motion does not wait for a time: give the stamp 0, so that it begins as soon as it is "
    "certified, and send the job when it may begin, or put it \"after\" another";

FormatPtr<Anything> header_format() {
  return object<Anything>({
      ignored<Anything>("stamp", make_format<NoTime>(kNoStamp), "Must be 0"),
      ignored<Anything>("frame_id", text(), "Ignored: joint positions have no frame"),
      ignored<Anything>("seq", integer(0, std::numeric_limits<int>::max()), "Ignored"),
  });
}

PartPtr<TrajectoryRequest> plain_parts() {
  using Trajectory = TrajectoryRequest;
  const ListSize points{.most = kWaypointsMax, .noun = "waypoints"};
  return parts<Trajectory>({
      required("joint_names", &Trajectory::joint_names, list(text()),
               "Names of the joints: prefix + URDF name. Joints of several arms make one "
               "synchronous motion. If of an arm only gripper joints are named, it stays"),
      required("points", &Trajectory::points, list(waypoint_format(), points),
               "Waypoints. A single waypoint is approached from where the arm will be"),
      ignored<Trajectory>("header", header_format(), ""),
  });
}

// Reads a plain trajectory and notes its place.
class Placed final : public CustomFormat<TrajectoryRequest> {
 public:
  void read(const JsonNode& node, TrajectoryRequest& out) const override {
    plain_->read(node, out);
    out.place = node.pointer();
  }
  void write(JsonWriter& out, const TrajectoryRequest& trajectory) const override {
    plain_->write(out, trajectory);
  }
  Schema schema(Way way) const override { return plain_->schema(way); }

 private:
  FormatPtr<TrajectoryRequest> plain_ =
      named("JointTrajectory", "A trajectory in the form of trajectory_msgs/JointTrajectory.",
            object<TrajectoryRequest>({plain_parts()}));
};

FormatPtr<TrajectoryRequest> plain_format() { return make_format<Placed>(); }

constexpr const char* kNested = "joint_trajectory";

bool is_nested(const JsonNode& node) { return node.raw().is_object() && node.has(kNested); }

class OnceNested final : public CustomFormat<TrajectoryRequest> {
 public:
  void read(const JsonNode& node, TrajectoryRequest& out) const override {
    if (!is_nested(node)) return plain_->read(node, out);
    node.invalid("unknown-field", "joint_trajectory must be nested only once");
  }
  void write(JsonWriter& out, const TrajectoryRequest& trajectory) const override {
    plain_->write(out, trajectory);
  }
  Schema schema(Way way) const override { return plain_->schema(way); }

 private:
  FormatPtr<TrajectoryRequest> plain_ = plain_format();
};

// Accepts only the empty multi-DOF trajectory that ROS prints, because no cell has multi-DOF
// joints.
class EmptyMultiDof final : public CustomFormat<Anything> {
 public:
  void read(const JsonNode& node, Anything&) const override {
    if (!node.is_object()) return;
    for (const char* part : {"joint_names", "points"}) {
      node.optional(part, [](const JsonNode& n) {
        if (n.array() && !n.raw().empty()) {
          n.invalid("unsupported", "multi-DOF joints are not supported: leave this list empty");
        }
      });
    }
  }
  void write(JsonWriter& out, const Anything&) const override { out.value(nullptr); }
  Schema schema(Way) const override {
    const Schema nothing{{"type", "array"}, {"items", Schema::object()}, {"maxItems", 0}};
    return {{"type", "object"}, {"properties", {{"joint_names", nothing}, {"points", nothing}}}};
  }
};

PartPtr<TrajectoryRequest> whole_trajectory(const char* key, const char* text,
                                            const FormatPtr<TrajectoryRequest>& format) {
  using Trajectory = TrajectoryRequest;
  return member<Trajectory>(
      {key, text, Need::required, {}}, format,
      [](const Trajectory& whole) { return std::optional(whole); },
      [](Trajectory& whole, Trajectory read) { whole = std::move(read); });
}

PartPtr<TrajectoryRequest> nested_parts() {
  using Trajectory = TrajectoryRequest;
  return parts<Trajectory>({
      whole_trajectory(kNested, "", make_format<OnceNested>()),
      ignored<Trajectory>("multi_dof_joint_trajectory", make_format<EmptyMultiDof>(),
                          "Must have no joints and no points"),
  });
}

FormatPtr<TrajectoryRequest> nested_format() {
  return named("RobotTrajectory", "A trajectory nested as in MoveIt.",
               object<TrajectoryRequest>({nested_parts()}));
}

class PlainOrNested final : public CustomFormat<TrajectoryRequest> {
 public:
  void read(const JsonNode& node, TrajectoryRequest& out) const override {
    if (!node.raw().is_array()) return read_one(node, out);
    if (node.raw().size() != 1) {
      return node.invalid("not-one-trajectory",
                          "a job has one trajectory, found a list of " +
                              std::to_string(node.raw().size()) +
                              ": send each as a job of its own (POST /batches)");
    }
    node.each([&](const JsonNode& only) { read_one(only, out); });
  }
  void write(JsonWriter& out, const TrajectoryRequest& trajectory) const override {
    plain_->write(out, trajectory);
  }
  Schema schema(Way way) const override {
    const Schema one{{"oneOf", Schema::array({plain_->schema(way), nested_->schema(way)})}};
    const Schema only{{"type", "array"}, {"items", one}, {"minItems", 1}, {"maxItems", 1}};
    return {{"oneOf", Schema::array({plain_->schema(way), nested_->schema(way), only})}};
  }

 private:
  void read_one(const JsonNode& node, TrajectoryRequest& out) const {
    (is_nested(node) ? nested_ : plain_)->read(node, out);
  }

  FormatPtr<TrajectoryRequest> plain_ = plain_format();
  FormatPtr<TrajectoryRequest> nested_ = nested_format();
};

class ToldTrajectory final : public CustomFormat<TrajectoryRequest> {
 public:
  void read(const JsonNode&, TrajectoryRequest&) const override {}
  void write(JsonWriter& out, const TrajectoryRequest& trajectory) const override {
    format_->write(out, trajectory);
  }
  Schema schema(Way) const override { return format_->schema(Way::in); }

 private:
  FormatPtr<TrajectoryRequest> format_ = plain_format();
};

constexpr const char* kNoTolerance =
    "tolerances of one job are not watched: leave it out, or give 0 for the server's own limits";

// Accepts a list of tolerances in which each value leaves the limit to the server (0) or asks for
// none (negative), as in control_msgs/JointTolerance.
class NoTolerances final : public CustomFormat<Anything> {
 public:
  void read(const JsonNode& node, Anything&) const override {
    node.each([](const JsonNode& joint) {
      if (!joint.object({"name", "position", "velocity", "acceleration"})) return;
      joint.optional("name", [](const JsonNode& n) {
        std::string name;
        (void)n.read(name);
      });
      for (const char* quantity : {"position", "velocity", "acceleration"}) {
        joint.optional(quantity, [](const JsonNode& n) {
          double value = 0.0;
          if (n.read(value) && value > 0.0) n.invalid("not-served", kNoTolerance);
        });
      }
    });
  }
  void write(JsonWriter& out, const Anything&) const override { out.value(nullptr); }
  Schema schema(Way) const override {
    const Schema none{{"type", "number"}, {"maximum", 0}};
    return {{"type", "array"},
            {"items",
             {{"type", "object"},
              {"additionalProperties", false},
              {"properties",
               {{"name", {{"type", "string"}}},
                {"position", none},
                {"velocity", none},
                {"acceleration", none}}}}}};
  }
};

PartPtr<TrajectoryRequest> action_goal_parts() {
  using Trajectory = TrajectoryRequest;
  return parts<Trajectory>({
      whole_trajectory("trajectory", "", trajectory_request_format()),
      ignored<Trajectory>("multi_dof_trajectory", make_format<EmptyMultiDof>(),
                          "Must have no joints and no points"),
      tolerance_parts<Trajectory>(),
  });
}

}  // namespace

FormatPtr<formats::Anything> no_tolerances() { return make_format<NoTolerances>(); }
FormatPtr<formats::Anything> no_time_tolerance() { return make_format<NoTime>(kNoTolerance); }

FormatPtr<TrajectoryRequest> action_goal_format() {
  static const FormatPtr<TrajectoryRequest> format =
      named("FollowJointTrajectoryGoal", "A goal of control_msgs/FollowJointTrajectory.",
            object<TrajectoryRequest>({action_goal_parts()}));
  return format;
}

PartPtr<TrajectoryRequest> bare_trajectory_parts() { return plain_parts(); }
PartPtr<TrajectoryRequest> bare_robot_trajectory_parts() { return nested_parts(); }

FormatPtr<TrajectoryRequest> trajectory_request_format() {
  static const FormatPtr<TrajectoryRequest> format = make_format<PlainOrNested>();
  return format;
}

FormatPtr<TrajectoryRequest> told_trajectory_format() {
  static const FormatPtr<TrajectoryRequest> format = make_format<ToldTrajectory>();
  return format;
}

}  // namespace armloom
