#include "server/codec/cell_format.h"

#include <array>
#include <cmath>

#include "core/executive/known_policies.h"
#include "server/codec/list_formats.h"
#include "server/codec/pose_words.h"
#include "server/codec/scalar_formats.h"

namespace armloom {
namespace {

using namespace formats;

constexpr Range kLength{0.0, 1000.0, true};  // m
constexpr Range kPosition{-1000.0, 1000.0};  // m
constexpr Range kAngle{-100.0, 100.0};       // rad
constexpr Range kTime{0.0, 1e6};             // s
constexpr Range kZeroToOne{0.0, 1.0};

// ---- Poses and shapes ----

PartPtr<Eigen::Isometry3d> pose_part() {
  return std::make_shared<SpeltPart<Eigen::Isometry3d, PoseWords>>(
      std::vector<PartPtr<PoseWords>>{
          field("xyz", &PoseWords::xyz_m, vector3(kPosition), "Position in metres."),
          field("rpy", &PoseWords::rpy_rad, vector3(kAngle),
                "Roll, pitch, yaw about fixed axes, in rad, as in a URDF."),
      },
      pose_in_words, pose_of_words);
}

struct ShapeWords {
  std::optional<Eigen::Vector3d> box;
  std::optional<std::array<double, 2>> cylinder;
  std::optional<std::array<double, 1>> sphere;
  std::optional<std::string> mesh;
  std::optional<Eigen::Vector3d> scale;
};

struct InWords {
  ShapeWords operator()(const Box& box) const { return {.box = box.size_m}; }
  ShapeWords operator()(const Cylinder& cylinder) const {
    return {.cylinder = std::array{cylinder.radius_m, cylinder.length_m}};
  }
  ShapeWords operator()(const Sphere& sphere) const {
    return {.sphere = std::array{sphere.radius_m}};
  }
  ShapeWords operator()(const Mesh& mesh) const { return {.mesh = mesh.path, .scale = mesh.scale}; }
};

ShapeWords shape_in_words(const Shape& shape) { return std::visit(InWords{}, shape); }

Shape shape_of_words(const ShapeWords& words) {
  if (words.cylinder) return Cylinder{(*words.cylinder)[0], (*words.cylinder)[1]};
  if (words.sphere) return Sphere{(*words.sphere)[0]};
  if (words.mesh) return Mesh{*words.mesh, words.scale.value_or(Eigen::Vector3d::Ones())};
  return Box{words.box.value_or(Eigen::Vector3d::Zero())};
}

PartPtr<Shape> shape_part() {
  return std::make_shared<SpeltPart<Shape, ShapeWords>>(
      std::vector<PartPtr<ShapeWords>>{
          field("box", &ShapeWords::box, vector3(kLength),
                "A box: its full side lengths, in metres."),
          field("cylinder", &ShapeWords::cylinder, numbers<2>(kLength),
                "A cylinder along z: radius and full length, in metres."),
          field("sphere", &ShapeWords::sphere, numbers<1>(kLength), "A sphere: radius, in metres."),
          field("mesh", &ShapeWords::mesh, path(),
                "A mesh (STL, OBJ, DAE): a file; in every check convex pieces that contain it."),
          field("scale", &ShapeWords::scale, vector3(kAnyNumber),
                "Of a mesh: factors along x, y, z of the file's lengths.", Schema{1, 1, 1}),
          exactly_one<ShapeWords>({"box", "cylinder", "sphere", "mesh"}),
          only_with<ShapeWords>("mesh", "scale"),
      },
      shape_in_words, shape_of_words);
}

// ---- Robots ----

// A limit by its two names: of joints that turn, and of those that slide.
std::vector<PartPtr<JointLimitsDescription>> limit(
    const std::string& name, std::optional<double> JointLimitsDescription::*where,
    const std::string& power, Range range, const std::string& text,
    std::optional<Schema> stated = std::nullopt) {
  const std::string angular = name + "_rad" + power;
  const std::string linear = name + "_m" + power;
  return {
      field(angular, where, number(range), text, stated),
      // Written once, by the name above: a description does not know how its joints move.
      read_only(field(linear, where, number(range), "The same of a joint that slides.", stated)),
      at_most_one<JointLimitsDescription>({angular, linear})};
}

FormatPtr<JointLimitsDescription> limits_format() {
  std::vector<PartPtr<JointLimitsDescription>> parts;
  const auto add = [&](std::vector<PartPtr<JointLimitsDescription>> more) {
    parts.insert(parts.end(), more.begin(), more.end());
  };
  using Limits = JointLimitsDescription;
  add(limit("lower", &Limits::lower, "", kAnyNumber,
            "Lowest position: narrows the URDF's limits, or gives what it lacks."));
  add(limit("upper", &Limits::upper, "", kAnyNumber, "Highest position, in the same way."));
  add(limit("velocity", &Limits::velocity, "_s", kPositive,
            "Highest velocity: at most the URDF's, or what it lacks."));
  add(limit("acceleration", &Limits::acceleration, "_s2", kPositive,
            "Highest acceleration; URDFs have none.", as_json(kDefaultAcceleration)));
  add(limit("jerk", &Limits::jerk, "_s3", kPositive, "Highest jerk; URDFs have none.",
            as_json(kDefaultJerk)));
  add(limit("brake", &Limits::brake, "_s2", kPositive,
            "Deceleration that a stop may use; twice the acceleration unless given."));
  return object(std::move(parts));
}

// "home": values, or the name of a state.
struct Home {
  std::vector<double> values;
  std::string state;
};

class HomeFormat final : public Format<Home> {
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
  Schema schema() const override {
    return {{"anyOf", Schema::array({values_->schema(), state_->schema()})}};
  }

 private:
  FormatPtr<std::vector<double>> values_ = list(number(kAnyNumber));
  FormatPtr<std::string> state_ = name();
};

PartPtr<ArmDescription> home_part() {
  return std::make_shared<MemberPart<ArmDescription, Home>>(
      MemberText{"home",
                 "Where the arm begins and parks: the joints' positions in the group's order (rad, "
                 "m), or the name of a state of the group in the SRDF. Every joint at zero, or at "
                 "the limit next to it, unless given.",
                 Need::optional,
                 {}},
      std::make_shared<HomeFormat>(),
      [](const ArmDescription& arm) -> std::optional<Home> {
        if (arm.home.empty() && arm.home_state.empty()) return std::nullopt;
        return Home{arm.home, arm.home_state};
      },
      [](ArmDescription& arm, Home home) {
        arm.home = std::move(home.values);
        arm.home_state = std::move(home.state);
      });
}

FormatPtr<ArmDescription> arm_format() {
  return object<ArmDescription>({
      required("name", &ArmDescription::name, name(), "The arm's name; unique in the cell."),
      required("group", &ArmDescription::group, name(),
               "The group of the SRDF that the arm consists of: a chain, or joints."),
      home_part(),
      field("limits", &ArmDescription::limits, dictionary(limits_format()),
            "Limits of joints of the arm and its gripper, by joint name without the prefix. They "
            "come before those of joint_limits and of the URDF."),
  });
}

FormatPtr<ControllerDescription> controller_format() {
  using Controller = ControllerDescription;
  return object<Controller>({
      field("type", &Controller::type, one_of({"sim"}), "What moves the arms: simulated ones."),
      field("lag_s", &Controller::lag, seconds(kTime),
            "How far a measured position is behind the commanded one, along the path."),
      field("noise_rad", &Controller::noise_rad, number(kZeroToOne),
            "Standard deviation of measured positions."),
  });
}

FormatPtr<RobotDescription> robot_format() {
  using Robot = RobotDescription;
  return object<Robot>({
      required("name", &Robot::name, name(), "The robot's name; unique in the cell."),
      required("urdf", &Robot::urdf, path(), "The robot's URDF."),
      required("srdf", &Robot::srdf, path(),
               "The robot's SRDF: groups, named states, pairs of links that need no check."),
      field("joint_limits", &Robot::joint_limits, path(),
            "MoveIt's joint_limits.yaml: velocities and accelerations of joints."),
      field("prefix", &Robot::prefix, text(),
            "Stands before every joint and link name of the robot: left_ makes left_joint_1."),
      field("base", &Robot::X_WB, object<Eigen::Isometry3d>({pose_part()}),
            "Where the root link of the URDF stands in the world."),
      field("packages", &Robot::packages, dictionary(path()),
            "The folder of each package that the URDF names: package://name/..."),
      field("fixed", &Robot::fixed, dictionary(number(kPosition)),
            "Joints that are held at a value (rad, m), as a torso under two arms: without the "
            "prefix. No job moves them."),
      required("arms", &Robot::arms, list(arm_format(), 1), "The robot's arms."),
      field("controller", &Robot::controller, controller_format(), "What moves the robot."),
  });
}

// ---- The scene and the settings ----

FormatPtr<ObjectDescription> make_object_format() {
  return object<ObjectDescription>({
      required("name", &ObjectDescription::name, name(),
               "The object's name; unique in the cell, and no link's or robot's name."),
      inlined(&ObjectDescription::shape, shape_part()),
      inlined(&ObjectDescription::X_WO, pose_part()),
  });
}

FormatPtr<CheckingSettings> checking_format() {
  using Checking = CheckingSettings;
  return object<Checking>({
      field("time_step_s", &Checking::time_step, seconds({1e-4, 10.0}),
            "Time between the instants that the policy timed_discrete compares."),
      field("tracking_error_rad", &Checking::tracking_error_rad, number(kZeroToOne),
            "How far each joint may be off its path: every proof covers it."),
      field("delay_s", &Checking::delay, seconds(kTime),
            "How far a motion may be behind its plan: every proof covers it. At least the "
            "controllers' lag_s."),
      field("limit_tolerance", &Checking::limit_tolerance, number(kZeroToOne),
            "Share by which a trajectory may exceed a limit of velocity, acceleration or jerk "
            "between its waypoints."),
  });
}

FormatPtr<SchedulingSettings> scheduling_format() {
  using Scheduling = SchedulingSettings;
  return object<Scheduling>({
      field("policy", &Scheduling::policy, one_of(known_policies()),
            "The rule by which jobs start; `armloom compare` shows what each makes of your jobs."),
      field("backlog_timeout_s", &Scheduling::backlog_timeout, seconds(kTime),
            "A job that has waited so long in the backlog expires, unless it says otherwise."),
      field("aging_s", &Scheduling::aging, seconds(kTime),
            "A job that has waited so long is overtaken no more."),
      field(
          "on_idle_blocker", &Scheduling::on_idle_blocker, one_of({"report", "park"}),
          "An arm without a job in the way of one: report tells of it, park sends the arm aside."),
  });
}

FormatPtr<MonitorSettings> monitor_format() {
  using Monitor = MonitorSettings;
  return object<Monitor>({
      field("rate_hz", &Monitor::rate_hz, number({1.0, 1000.0}),
            "How often the measured state is looked at."),
      field("reaction_s", &Monitor::reaction, seconds(kTime),
            "Time from a finding to the first arm that brakes."),
      field("stop_clearance_m", &Monitor::stop_clearance_m, number(kZeroToOne),
            "Links closer than this stop their arms. At most clearance_m."),
  });
}

FormatPtr<ExecutionSettings> execution_format() {
  using Execution = ExecutionSettings;
  return object<Execution>({
      field("start_tolerance_rad", &Execution::start_tolerance_rad, number(kZeroToOne),
            "How far an arm may stand from where its job begins."),
      field("duration_scaling", &Execution::duration_scaling, number({1.0, 100.0}),
            "A motion fails as overrun when it takes longer than this times its duration, plus the "
            "margin, and no longer moves."),
      field("duration_margin_s", &Execution::duration_margin, seconds(kTime),
            "The margin of that."),
  });
}

PartPtr<CellDescription> make_settings_part() {
  using Description = CellDescription;
  return std::make_shared<Parts<Description>>(std::vector<PartPtr<Description>>{
      field("clearance_m", &Description::clearance_m, number(kZeroToOne),
            "What every admitted motion keeps from other arms and the scene."),
      field("self_clearance_m", &Description::self_clearance_m, number(kZeroToOne),
            "What an arm's own links keep from each other; at most clearance_m counts."),
      field("checking", &Description::checking, checking_format(),
            "What the checks of motions allow for."),
      field("scheduling", &Description::scheduling, scheduling_format(), "Which job goes when."),
      field("monitor", &Description::monitor, monitor_format(),
            "The watch over the measured state of all arms."),
      field("execution", &Description::execution, execution_format(),
            "When a motion may begin and when it has failed; the defaults are MoveIt's."),
  });
}

}  // namespace

const Format<ObjectDescription>& object_format() {
  static const FormatPtr<ObjectDescription> format = make_object_format();
  return *format;
}

const Part<CellDescription>& settings_part() {
  static const PartPtr<CellDescription> part = make_settings_part();
  return *part;
}

const Format<CellDescription>& cell_format() {
  using Description = CellDescription;
  static const FormatPtr<Description> format = object<Description>({
      ignored<Description>("$schema", path(),
                           "This schema: editors check and complete the file by it."),
      required("name", &Description::name, name(), "The cell's name."),
      required("robots", &Description::robots, list(robot_format(), 1),
               "The robots with their arms."),
      field("objects", &Description::objects, list(make_object_format()),
            "The scene at start: tables, fixtures, fences."),
      field("allowed_collisions", &Description::allowed_collisions, list(pair_of(name())),
            "Pairs that may touch: two links, or a link and an object; links with their prefix."),
      make_settings_part(),
  });
  return *format;
}

}  // namespace armloom
