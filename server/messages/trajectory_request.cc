#include "server/messages/trajectory_request.h"

#include <cstdint>
#include <limits>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

namespace {

// {"sec", "nanosec"} as ROS 2 prints a time, {"secs", "nsecs"} as ROS 1 does.
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

FormatPtr<WaypointRequest> waypoint_format() {
  using Point = WaypointRequest;
  const auto time =
      named<double>("Time", "ROS 2's, ROS 1's, or a number of seconds.", make_format<TimeFormat>());
  return named("Waypoint", "",
               object<Point>({
                   required("positions", &Point::positions, number_list(),
                            "rad or m, in the order of joint_names"),
                   field("velocities", &Point::velocities, number_list(),
                         "Absent: refused, since the motion could not begin and end at rest"),
                   field("accelerations", &Point::accelerations, number_list(),
                         "In all waypoints (quintic) or in none (cubic)"),
                   ignored<Point>("effort", anything("array"), "Read over"),
                   field("time_from_start", &Point::time_from_start_s, time,
                         "Absent: refused, unless the job says \"retime\""),
               }));
}

FormatPtr<TrajectoryRequest> plain_format() {
  using Trajectory = TrajectoryRequest;
  const ListSize points{.most = kWaypointsMax, .noun = "waypoints"};
  return named("JointTrajectory", "The shape of trajectory_msgs/JointTrajectory.",
               object<Trajectory>({
                   required("joint_names", &Trajectory::joint_names, list(text()),
                            "Prefix + URDF name; joints of several arms make one synchronous "
                            "motion"),
                   required("points", &Trajectory::points, list(waypoint_format(), points), ""),
                   ignored<Trajectory>("header", anything("object"), "Read over"),
               }));
}

constexpr const char* kNested = "joint_trajectory";

bool is_nested(const JsonNode& node) { return node.raw().is_object() && node.has(kNested); }

// The trajectory inside of a nested one.
class OnceNested final : public CustomFormat<TrajectoryRequest> {
 public:
  void read(const JsonNode& node, TrajectoryRequest& out) const override {
    if (!is_nested(node)) return plain_->read(node, out);
    node.invalid("unknown-field", "a trajectory is nested once, not twice");
  }
  void write(JsonWriter& out, const TrajectoryRequest& trajectory) const override {
    plain_->write(out, trajectory);
  }
  Schema schema(Way way) const override { return plain_->schema(way); }

 private:
  FormatPtr<TrajectoryRequest> plain_ = plain_format();
};

// The trajectory of floating joints, which no cell has, as ROS prints one that is empty.
class EmptyMultiDof final : public CustomFormat<Anything> {
 public:
  void read(const JsonNode& node, Anything&) const override {
    if (!node.is_object()) return;
    for (const char* part : {"joint_names", "points"}) {
      node.optional(part, [](const JsonNode& n) {
        if (n.array() && !n.raw().empty()) {
          n.invalid("unsupported", "joints of several degrees of freedom are not moved by any arm");
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

FormatPtr<TrajectoryRequest> nested_format() {
  using Trajectory = TrajectoryRequest;
  return named("RobotTrajectory", "MoveIt's nesting.",
               object<Trajectory>({
                   member<Trajectory>(
                       {kNested, "", Need::required, {}}, make_format<OnceNested>(),
                       [](const Trajectory& whole) { return std::optional(whole); },
                       [](Trajectory& whole, Trajectory read) { whole = std::move(read); }),
                   ignored<Trajectory>("multi_dof_joint_trajectory", make_format<EmptyMultiDof>(),
                                       "Must be empty"),
               }));
}

class PlainOrNested final : public CustomFormat<TrajectoryRequest> {
 public:
  void read(const JsonNode& node, TrajectoryRequest& out) const override {
    (is_nested(node) ? nested_ : plain_)->read(node, out);
  }
  void write(JsonWriter& out, const TrajectoryRequest& trajectory) const override {
    plain_->write(out, trajectory);
  }
  Schema schema(Way way) const override {
    return {{"oneOf", Schema::array({plain_->schema(way), nested_->schema(way)})}};
  }

 private:
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
  FormatPtr<TrajectoryRequest> format_ = trajectory_request_format();
};

}  // namespace

FormatPtr<TrajectoryRequest> trajectory_request_format() {
  static const FormatPtr<TrajectoryRequest> format = make_format<PlainOrNested>();
  return format;
}

FormatPtr<TrajectoryRequest> told_trajectory_format() {
  static const FormatPtr<TrajectoryRequest> format = make_format<ToldTrajectory>();
  return format;
}

}  // namespace armloom
