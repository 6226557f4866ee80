#include "server/codec/robot_format.h"

#include <optional>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/scene_format.h"

namespace armloom {

using namespace formats;

namespace {

constexpr Range kHeld{-1000.0, 1000.0};  // rad or m

struct LimitText {
  const char* angular;  // keys with angular and with linear units
  const char* linear;
  const char* text;
  std::optional<Schema> stated = {};
};

// Describes a limit that has two keys: one for revolute and one for prismatic joints.
PartPtr<JointLimitsDescription> limit(const LimitText& said,
                                      std::optional<double> JointLimitsDescription::*where,
                                      Range range) {
  using Limits = JointLimitsDescription;
  // If neither key was given, the limit is written with the angular key.
  const auto part = [&](const char* key, bool is_linear, const char* words) {
    return member<Limits>(
        {key, words, Need::optional, said.stated}, number(range),
        [where, linear = said.linear, is_linear](const Limits& limits) {
          return limits.keys.contains(linear) == is_linear ? limits.*where : std::nullopt;
        },
        [where, key](Limits& limits, double value) {
          limits.*where = value;
          limits.keys.insert(key);
        });
  };
  return parts<Limits>({part(said.angular, false, said.text),
                        part(said.linear, true, "The same for a prismatic joint."),
                        at_most_one<Limits>({said.angular, said.linear})});
}

FormatPtr<JointLimitsDescription> limits_format() {
  using Limits = JointLimitsDescription;
  return object<Limits>({
      limit({"lower_rad", "lower_m",
             "Lowest position: narrows the limit of the URDF, or sets a missing limit."},
            &Limits::lower, kAnyNumber),
      limit({"upper_rad", "upper_m",
             "Highest position: narrows the limit of the URDF, or sets a missing limit."},
            &Limits::upper, kAnyNumber),
      limit({"velocity_rad_s", "velocity_m_s",
             "Highest velocity: lowers the limit of the URDF, or sets a missing limit."},
            &Limits::velocity, kPositive),
      limit({"acceleration_rad_s2", "acceleration_m_s2",
             "Highest acceleration; overrides joint_limits. URDFs have none.",
             as_json(kDefaultAcceleration)},
            &Limits::acceleration, kPositive),
      limit({"jerk_rad_s3", "jerk_m_s3", "Highest jerk; overrides joint_limits. URDFs have none.",
             as_json(kDefaultJerk)},
            &Limits::jerk, kPositive),
      limit({"brake_rad_s2", "brake_m_s2",
             "Deceleration of a stop; default: twice the acceleration."},
            &Limits::brake, kPositive),
  });
}

// Member "home": positions, or the name of a state.
struct Home {
  std::vector<double> values;
  std::string state;
};

class HomeFormat final : public CustomFormat<Home> {
 public:
  void read(const JsonNode& node, Home& out) const override {
    if (node.raw().is_array()) return values_->read(node, out.values);
    if (node.raw().is_string()) return state_->read(node, out.state);
    node.fault(ProblemKind::malformed, "wrong-type",
               std::string("expected an array of numbers, or the name of a state, found ") +
                   node.raw().type_name());
  }
  void write(JsonWriter& out, const Home& home) const override {
    if (home.state.empty()) return values_->write(out, home.values);
    state_->write(out, home.state);
  }
  Schema schema(Way way) const override {
    return {{"anyOf", Schema::array({values_->schema(way), state_->schema(way)})}};
  }

 private:
  FormatPtr<std::vector<double>> values_ = list(number(kAnyNumber));
  FormatPtr<std::string> state_ = name();
};

PartPtr<ArmDescription> home_part() {
  return member<ArmDescription>(
      {"home",
       "Start and parking configuration: joint positions in the group's order (rad, m), or the "
       "name of a state in the SRDF: of the group, or of another group that gives each of these "
       "joints a position (both_arms). Default: every joint at zero, or at the limit closest to "
       "zero.",
       Need::optional,
       {}},
      make_format<HomeFormat>(),
      [](const ArmDescription& arm) -> std::optional<Home> {
        if (arm.home.empty() && arm.home_state.empty()) return std::nullopt;
        return Home{arm.home, arm.home_state};
      },
      [](ArmDescription& arm, Home home) {
        arm.home = std::move(home.values);
        arm.home_state = std::move(home.state);
      });
}

FormatPtr<PayloadDescription> payload_format() {
  using Payload = PayloadDescription;
  return object<Payload>({
      required("max_kg", &Payload::max_kg, number(Payload::mass_range),
               "Largest mass that the arm may hold, in kilograms."),
      required(
          "brake_at_max", &Payload::brake_at_max, number(Payload::brake_range),
          "Share of the limits of braking and acceleration that the arm keeps with this mass. "
          "With less mass it keeps more, in proportion. The arm moves at the square root of its "
          "share, so that it stops within the same distance as with empty hands."),
      field("lever_m", &Payload::lever_m, number(Payload::lever_range),
            "How far the center of mass may be from the origin of the link that carries the "
            "object, in meters. A mass farther away counts as more, in proportion."),
  });
}

FormatPtr<ArmDescription> arm_description_format() {
  return object<ArmDescription>({
      required("name", &ArmDescription::name, name(), "Name of the arm; unique in the cell."),
      required("group", &ArmDescription::group, name(),
               "SRDF group that makes up the arm; the group is a chain or a list of joints."),
      home_part(),
      field("gripper", &ArmDescription::gripper, dictionary(number(kHeld)),
            "Start positions of the gripper's joints (rad, m), by joint name without prefix. "
            "Default: each joint at zero, or at the limit closest to zero. Jobs can move these "
            "joints."),
      field("payload", &ArmDescription::payload, payload_format(),
            "What the arm may carry. With an object of a mass the arm brakes less, so it moves "
            "slower. Default: the arm holds only objects without a mass."),
      field("limits", &ArmDescription::limits, dictionary(limits_format()),
            "Limits of joints of the arm and its gripper, by joint name without prefix. These "
            "limits take precedence over joint_limits and the URDF."),
  });
}

FormatPtr<ControllerDescription> controller_format() {
  using Controller = ControllerDescription;
  return object<Controller>({
      field("type", &Controller::type, controller_type_format(),
            "Kind of controller. sim: a simulated arm in the server. remote: a controller in a "
            "process of its own, for example `armloom arm`."),
      field("lag_s", &Controller::lag, seconds(Controller::lag_range),
            "Simulated arms: delay of the measured position behind the commanded one, along the "
            "path."),
      field("noise_rad", &Controller::noise_rad, number(Controller::noise_range),
            "Simulated arms: standard deviation of the noise of measured positions."),
      field("endpoint", &Controller::endpoint, text(),
            "Address of a remote controller: unix:PATH or tcp:HOST:PORT."),
      field("reaction_s", &Controller::reaction, seconds(Controller::reaction_range),
            "Promise: time from a command to its effect on the arm."),
      field("feedback_period_s", &Controller::feedback_period,
            seconds(Controller::feedback_period_range),
            "Promise: time between two reports of the controller."),
      field("feedback_timeout_s", &Controller::feedback_timeout,
            seconds(Controller::feedback_timeout_range),
            "Age of the last report after which the arm counts as lost and is stopped."),
      field("tracking_error_rad", &Controller::tracking_error_rad,
            number(CheckingSettings::tracking_error_range),
            "Promise: largest deviation of a joint from its path. Default: the cell's "
            "checking.tracking_error_rad."),
  });
}

}  // namespace

FormatPtr<std::string> controller_type_format() { return one_of({"sim", "remote"}); }

FormatPtr<RobotDescription> robot_format() {
  using Robot = RobotDescription;
  return object<Robot>({
      required("name", &Robot::name, name(), "Name of the robot; unique in the cell."),
      required("urdf", &Robot::urdf, path(), "Path of the URDF."),
      required(
          "srdf", &Robot::srdf, path(),
          "Path of the SRDF: groups, named states, and disabled pairs of links, which need no "
          "check. A disabled pair is still checked if it belongs to different arms, or to an arm "
          "and a body other than its mount, unless the two are proven out of reach of each other."),
      field("joint_limits", &Robot::joint_limits, path(),
            "Path of MoveIt's joint_limits.yaml: velocity and acceleration limits."),
      field("prefix", &Robot::prefix, text(),
            "Prefix of every joint and link name of the robot: with left_, joint_1 becomes "
            "left_joint_1."),
      field(
          "srdf_prefix", &Robot::srdf_prefix, text(),
          "Prefix that the joint and link names of the URDF have and those of the SRDF lack: with "
          "ur_, base_link in the SRDF means ur_base_link of the URDF. Names of groups and states "
          "are not changed."),
      field("joint_limits_prefix", &Robot::joint_limits_prefix, text(),
            "The same for the joint names in joint_limits."),
      field("base", &Robot::X_WB, object<Eigen::Isometry3d>({pose_part()}),
            "Pose of the URDF's root link in the world."),
      field("packages", &Robot::packages, dictionary(path()),
            "Folder of each package in the URDF's package://name/... paths. Also applies to "
            "file:///any/folder/name/... addresses of files that this machine lacks."),
      field("fixed", &Robot::fixed, dictionary(number(kHeld)),
            "Joints that no job moves, with their positions (rad, m), for example of a torso under "
            "two arms. Names are without prefix."),
      required("arms", &Robot::arms, list(arm_description_format(), {.fewest = 1}),
               "Arms of the robot."),
      field("controller", &Robot::controller, controller_format(), "Controller of the robot."),
  });
}

}  // namespace armloom
