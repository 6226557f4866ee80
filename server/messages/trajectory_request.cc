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

FormatPtr<WaypointRequest> waypoint_format() {
  using Point = WaypointRequest;
  const auto time = named<double>("Time", "A ROS 2 time, a ROS 1 time, or a number of seconds.",
                                  make_format<TimeFormat>());
  return named(
      "Waypoint", "",
      object<Point>({
          required("positions", &Point::positions, number_list(),
                   "Joint positions in the order of `joint_names`: rad or m"),
          field("velocities", &Point::velocities, number_list(),
                "Joint velocities; required unless the job has `retime`, because the motion must "
                "begin and end at rest"),
          field("accelerations", &Point::accelerations, number_list(),
                "Joint accelerations, in all waypoints (quintic splines) or in none (cubic)"),
          ignored<Point>("effort", anything("array"), "Ignored"),
          field("time_from_start", &Point::time_from_start_s, time,
                "Time from the start; required unless the job has `retime`"),
      }));
}

FormatPtr<TrajectoryRequest> plain_format() {
  using Trajectory = TrajectoryRequest;
  const ListSize points{.most = kWaypointsMax, .noun = "waypoints"};
  return named("JointTrajectory", "A trajectory in the form of trajectory_msgs/JointTrajectory.",
               object<Trajectory>({
                   required("joint_names", &Trajectory::joint_names, list(text()),
                            "Names of the joints: prefix + URDF name. Joints of several arms make "
                            "one synchronous motion"),
                   required("points", &Trajectory::points, list(waypoint_format(), points), ""),
                   ignored<Trajectory>("header", anything("object"), "Ignored"),
               }));
}

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

FormatPtr<TrajectoryRequest> nested_format() {
  using Trajectory = TrajectoryRequest;
  return named("RobotTrajectory", "A trajectory nested as in MoveIt.",
               object<Trajectory>({
                   member<Trajectory>(
                       {kNested, "", Need::required, {}}, make_format<OnceNested>(),
                       [](const Trajectory& whole) { return std::optional(whole); },
                       [](Trajectory& whole, Trajectory read) { whole = std::move(read); }),
                   ignored<Trajectory>("multi_dof_joint_trajectory", make_format<EmptyMultiDof>(),
                                       "Must have no joints and no points"),
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
