#include "server/messages/cell.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/executive/known_policies.h"
#include "server/codec/cell_format.h"
#include "server/codec/list_formats.h"
#include "server/codec/output_part.h"
#include "server/codec/robot_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/scene_format.h"
#include "server/codec/value_formats.h"
#include "server/messages/mesh_address.h"
#include "server/messages/scene.h"

namespace armloom {

using namespace formats;

namespace {

std::vector<double> numbers_of(const Eigen::VectorXd& numbers) {
  return {numbers.begin(), numbers.end()};
}

std::map<std::string, std::vector<double>> named_states(const CellArmView& view) {
  std::map<std::string, std::vector<double>> states;
  for (const auto& [name, q] : view.arm->named_states) states.emplace(name, numbers_of(q));
  return states;
}

FormatPtr<CellArmView> arm_view_format() {
  using View = CellArmView;
  return named(
      "CellArm", "",
      object<View>({
          output_only(
              "name", [](const View& view) { return view.arm->name; }, text()),
          output_only(
              "group", [](const View& view) { return view.arm->group; }, text(),
              "Group of the SRDF"),
          output_only("joints", &View::joints, list(text())),
          output_only("gripper_joints", &View::gripper_joints, list(text())),
          output_only(
              "home", [](const View& view) { return numbers_of(view.arm->home); }, number_list()),
          output_only("named_states", named_states, dictionary(number_list())),
      }));
}

std::map<std::string, std::string> mesh_addresses(const CellRobotView& view) {
  std::map<std::string, std::string> addresses;
  for (const auto& [uri, path] : view.robot->mesh_files) addresses.emplace(uri, mesh_address(path));
  return addresses;
}

template <class Member>
auto of_controller(Member ControllerDescription::*where) {
  return [where](const CellRobotView& view) { return view.robot->controller.*where; };
}

FormatPtr<CellRobotView> controller_view_format() {
  using Controller = ControllerDescription;
  return named(
      "CellController", "The kind of a robot's controller, and what it promises.",
      object<CellRobotView>({
          output_only("type", of_controller(&Controller::type), controller_type_format(),
                      "sim: simulated by the server; takes faults. remote: in a process of "
                      "its own"),
          output_only("reaction_s", of_controller(&Controller::reaction),
                      seconds(Controller::reaction_range),
                      "Longest time from a command to its effect on the arm"),
          output_only("feedback_period_s", of_controller(&Controller::feedback_period),
                      seconds(Controller::feedback_period_range),
                      "Longest time between two reports"),
          output_only("feedback_timeout_s", of_controller(&Controller::feedback_timeout),
                      seconds(Controller::feedback_timeout_range),
                      "Age of the last report after which the arm is stopped"),
          output_only("tracking_error_rad", &CellRobotView::tracking_error_rad,
                      number(CheckingSettings::tracking_error_range),
                      "Largest deviation of a joint from its path: rad or m"),
      }));
}

const CellRobotView* itself(const CellRobotView& view) { return &view; }

FormatPtr<CellRobotView> robot_view_format() {
  using View = CellRobotView;
  return named("CellRobot", "",
               object<View>({
                   output_only(
                       "name", [](const View& view) { return view.robot->name; }, text()),
                   output_only(
                       "prefix", [](const View& view) { return view.robot->prefix; }, text()),
                   output_only(
                       "base", [](const View& view) { return view.robot->X_WB; },
                       object<Eigen::Isometry3d>({pose_part()})),
                   output_only(
                       "urdf", [](const View& view) { return view.robot->urdf_text; }, text(),
                       "Text of the URDF; names without the prefix"),
                   output_only(
                       "srdf", [](const View& view) { return view.robot->srdf_text; }, text(),
                       "Text of the SRDF"),
                   output_only("meshes", mesh_addresses, dictionary(text()),
                               "Path of each mesh file, by the name that the URDF uses"),
                   output_only("controller", itself, controller_view_format()),
                   output_only("arms", &View::arms, list(arm_view_format())),
               }));
}

bool is_simulated(const CellView& view) {
  return std::ranges::all_of(view.cell->robots,
                             [](const Robot& robot) { return robot.controller.type == "sim"; });
}

PartPtr<CellJointView> limit(const char* key, double Joint::*where) {
  return output_only(
      key,
      [where](const CellJointView& view) {
        const double limit = view.joint->*where;
        return std::abs(limit) < kFarthestPosition ? std::optional(limit) : std::nullopt;
      },
      nullable(number(kAnyNumber)), "null if the joint has no such limit");
}
PartPtr<CellJointView> bound(const char* key, double Joint::*where) {
  return output_only(
      key, [where](const CellJointView& view) { return view.joint->*where; }, number(kPositive));
}

FormatPtr<CellJointView> joint_view_format() {
  using View = CellJointView;
  return named(
      "CellJoint", "",
      object<View>({
          output_only(
              "name", [](const View& view) { return view.joint->name; }, text()),
          output_only("arm", &View::arm, text_or_null(), "Arm of the joint; null if no arm has it"),
          limit("lower", &Joint::lower),
          limit("upper", &Joint::upper),
          bound("velocity_max", &Joint::velocity_max),
          bound("acceleration_max", &Joint::acceleration_max),
          bound("jerk_max", &Joint::jerk_max),
          bound("brake", &Joint::brake),
          output_only(
              "unit", [](const View& view) { return view.joint->unit(); }, one_of({"rad", "m"})),
      }));
}

}  // namespace

CellDescription settings_of(const Cell& cell) {
  CellDescription settings;
  settings.clearance_m = cell.clearances.clearance_m;
  settings.self_clearance_m = cell.clearances.self_clearance_m;
  settings.mount_clearance_m = cell.clearances.mount_limit_m();
  settings.checking = cell.checking;
  settings.scheduling = cell.scheduling;
  settings.monitor = cell.monitor;
  settings.execution = cell.execution;
  return settings;
}

CellView view_of(const Cell& cell, std::string policy, double speed) {
  CellView view{&cell, std::move(policy), speed, {}, {}, {}};
  const auto names = [&](const std::vector<JointId>& ids) {
    std::vector<std::string> list;
    for (const JointId id : ids) list.push_back(cell.joint(id).name);
    return list;
  };
  for (std::uint32_t i = 0; i < cell.robots.size(); ++i) {
    const Robot& robot = cell.robots[i];
    CellRobotView& of =
        view.robots.emplace_back(CellRobotView{&robot, cell.tracking_error(RobotId(i)), {}});
    for (const ArmId id : robot.arms) {
      const Arm& arm = cell.arm(id);
      of.arms.push_back({&arm, names(arm.joints), names(arm.gripper_joints)});
    }
  }
  for (const Joint& joint : cell.joints) {
    view.joints.push_back({&joint, joint.arm ? cell.arm(*joint.arm).name : ""});
  }
  view.settings = settings_of(cell);
  return view;
}

FormatPtr<CellView> cell_view_format() {
  using View = CellView;
  static const auto format =
      named("Cell", "",
            object<View>({
                output_only(
                    "name", [](const View& view) { return view.cell->name; }, text()),
                output_only("policy", &View::policy, text(), "Present policy"),
                output_only("speed", &View::speed, number(kPositive),
                            "Seconds of cell time per second of wall time"),
                output_only("simulated", is_simulated, flag(),
                            "true if every arm is simulated, so that no real drive moves"),
                output_only("robots", &View::robots, list(robot_view_format())),
                output_only(
                    "objects", [](const View& view) { return &view.cell->objects; },
                    list(object_format())),
                output_only("joints", &View::joints, list(joint_view_format())),
                inlined(&View::settings, settings_part()),
            }));
  return format;
}

FormatPtr<PolicyChoice> policy_choice_format() {
  static const auto format = named(
      "PolicyChoice", "",
      object<PolicyChoice>({required("policy", &PolicyChoice::policy, one_of(known_policies()),
                                     "The policy that applies from now on")}));
  return format;
}

}  // namespace armloom
