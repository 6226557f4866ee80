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
  const char* angular;  // the key with angular and with linear units
  const char* linear;
  const char* text;
  std::optional<Schema> stated = {};  // its default
};

// A limit by its two names: of joints that turn, and of those that slide.
PartPtr<JointLimitsDescription> limit(const LimitText& said,
                                      std::optional<double> JointLimitsDescription::*where,
                                      Range range) {
  using Limits = JointLimitsDescription;
  // What was given by neither name is written by the first.
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
                        part(said.linear, true, "The same of a joint that slides."),
                        at_most_one<Limits>({said.angular, said.linear})});
}

FormatPtr<JointLimitsDescription> limits_format() {
  using Limits = JointLimitsDescription;
  return object<Limits>({
      limit({"lower_rad", "lower_m",
             "Lowest position: narrows the URDF's limits, or gives what it lacks."},
            &Limits::lower, kAnyNumber),
      limit({"upper_rad", "upper_m", "Highest position, in the same way."}, &Limits::upper,
            kAnyNumber),
      limit({"velocity_rad_s", "velocity_m_s",
             "Highest velocity: at most the URDF's, or what it lacks."},
            &Limits::velocity, kPositive),
      limit({"acceleration_rad_s2", "acceleration_m_s2",
             "Highest acceleration: before that of joint_limits; URDFs have none.",
             as_json(kDefaultAcceleration)},
            &Limits::acceleration, kPositive),
      limit({"jerk_rad_s3", "jerk_m_s3", "Highest jerk, in the same way.", as_json(kDefaultJerk)},
            &Limits::jerk, kPositive),
      limit({"brake_rad_s2", "brake_m_s2",
             "Deceleration that a stop may use; twice the acceleration unless given."},
            &Limits::brake, kPositive),
  });
}

// "home": values, or the name of a state.
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
       "Where the arm begins and parks: the joints' positions in the group's order (rad, "
       "m), or the name of a state of the group in the SRDF. Every joint at zero, or at "
       "the limit next to it, unless given.",
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

FormatPtr<ArmDescription> arm_description_format() {
  return object<ArmDescription>({
      required("name", &ArmDescription::name, name(), "The arm's name; unique in the cell."),
      required("group", &ArmDescription::group, name(),
               "The group of the SRDF that the arm consists of: a chain, or joints."),
      home_part(),
      field("gripper", &ArmDescription::gripper, dictionary(number(kHeld)),
            "Where joints of the arm's gripper stand at the start (rad, m), by joint name without "
            "the prefix; at zero, or at the limit next to it, unless given. Jobs move them."),
      field("limits", &ArmDescription::limits, dictionary(limits_format()),
            "Limits of joints of the arm and its gripper, by joint name without the prefix. They "
            "come before those of joint_limits and of the URDF."),
  });
}

FormatPtr<ControllerDescription> controller_format() {
  using Controller = ControllerDescription;
  return object<Controller>({
      field("type", &Controller::type, one_of({"sim"}), "What moves the arms: simulated ones."),
      field("lag_s", &Controller::lag, seconds(Controller::lag_range),
            "How far a measured position is behind the commanded one, along the path."),
      field("noise_rad", &Controller::noise_rad, number(Controller::noise_range),
            "Standard deviation of measured positions."),
  });
}

}  // namespace

FormatPtr<RobotDescription> robot_format() {
  using Robot = RobotDescription;
  return object<Robot>({
      required("name", &Robot::name, name(), "The robot's name; unique in the cell."),
      required("urdf", &Robot::urdf, path(), "The robot's URDF."),
      required(
          "srdf", &Robot::srdf, path(),
          "The robot's SRDF: groups, named states, pairs of links that need no check. Pairs of "
          "different arms, or of an arm and what stands beside its mount, are checked all the "
          "same unless they are proven out of reach."),
      field("joint_limits", &Robot::joint_limits, path(),
            "MoveIt's joint_limits.yaml: velocities and accelerations of joints."),
      field("prefix", &Robot::prefix, text(),
            "Stands before every joint and link name of the robot: left_ makes left_joint_1."),
      field("base", &Robot::X_WB, object<Eigen::Isometry3d>({pose_part()}),
            "Where the root link of the URDF stands in the world."),
      field("packages", &Robot::packages, dictionary(path()),
            "The folder of each package that the URDF names: package://name/..."),
      field("fixed", &Robot::fixed, dictionary(number(kHeld)),
            "Joints that are held at a value (rad, m), as a torso under two arms: without the "
            "prefix. No job moves them."),
      required("arms", &Robot::arms, list(arm_description_format(), {.fewest = 1}),
               "The robot's arms."),
      field("controller", &Robot::controller, controller_format(), "What moves the robot."),
  });
}

}  // namespace armloom
