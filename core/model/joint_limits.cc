#include <algorithm>
#include <cmath>
#include <limits>

#include "core/model/robot_build.h"

namespace armloom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Files round: a limit that is above the URDF's by less than this share is the URDF's.
constexpr double kRounding = 1e-3;

// What an arm's joint needs and no file gives, as members of the cell file's "limits".
struct Needs {
  std::string names;    // "velocity of j1, position of j2"
  std::string members;  // "\"j1\": {\"velocity_rad_s\": 1}"
};

void append(std::string& list, const char* separator, const std::string& item) {
  if (!list.empty()) list += separator;
  list += item;
}

// A member of a JSON object.
std::string member(const std::string& key, const std::string& value) {
  std::string text("\"");
  text += key;
  text += "\": ";
  return text += value;
}

// Settles the limits of one joint. Whose joint it is decides what has to be known of it: an arm's
// own joint needs all; a gripper's joint takes defaults, with a warning; what no arm moves needs
// nothing.
class LimitsOfJoint {
 public:
  LimitsOfJoint(const RobotBuild& robot, TreeLink& link, Joint& joint, const ArmBuild* arm,
                bool own, Findings& findings)
      : robot_(robot), link_(link), joint_(joint), arm_(arm), own_(own), findings_(findings) {
    if (arm_ != nullptr) {
      const auto given = arm_->description->limits.find(link.joint);
      if (given != arm_->description->limits.end()) cell_ = given->second;
      pointer_ = arm_->pointer + "/limits/" + pointer_token(link.joint);
    }
  }

  void settle(LimitsFile::Joint* filed, Needs& needs) {
    if (filed != nullptr) {
      if (arm_ != nullptr)
        findings_.merge(filed->faults);
      else
        findings_.merge_as_warnings(filed->faults);
      file_ = filed->limits;
      place_ = filed->place;
    }
    settle_positions();
    settle_velocity();
    settle_rates();
    // A faulty limit that another file replaces, or nobody needs, is only odd.
    if (own_ && !missing_.empty()) {
      findings_.merge(std::move(link_.limits.faults));
      append(needs.names, ", ", words_ + " of " + link_.joint);
      append(needs.members, ", ", member(link_.joint, "{" + missing_ + "}"));
    } else {
      findings_.merge_as_warnings(std::move(link_.limits.faults));
    }
  }

 private:
  [[nodiscard]] std::string key(const char* what, const char* angular, const char* linear) const {
    return std::string(what) + (joint_.kind == JointKind::prismatic ? linear : angular);
  }

  void warn(const std::string& slug, const std::string& place, const std::string& sentence,
            double value) {
    findings_.warn({ProblemKind::invalid, slug, place, place + ": " + sentence, value});
  }

  void need(const std::string& word, const std::string& members) {
    append(words_, " and ", word);
    append(missing_, ", ", members);
  }

  // The cell's number if it can be one and is no wider than the URDF's; `wider` compares with that.
  std::optional<double> from_cell(const std::optional<double>& value, const std::string& name,
                                  const std::optional<double>& urdf, bool wider) {
    if (!value) return std::nullopt;
    if (!std::isfinite(*value)) {
      refuse("not-a-number", name, " is " + text_of(*value) + ", it must be finite", *value);
      return std::nullopt;
    }
    if (!urdf || !wider) return value;
    refuse("limit-exceeded", name,
           " is " + text_of(*value) + ", wider than the URDF's " + text_of(*urdf), *value);
    return std::nullopt;
  }

  void refuse(const char* slug, const std::string& name, const std::string& rest, double value) {
    findings_.in_cell(slug, pointer_ + "/" + name, "joint " + link_.joint + ": " + name + rest,
                      value);
  }

  // The number of joint_limits.yaml, or the URDF's where that is narrower.
  std::optional<double> from_file(const std::optional<double>& value, const char* name,
                                  const std::optional<double>& urdf, double wider_by) {
    if (!value || !urdf || wider_by <= 0.0) return value ? value : urdf;
    if (wider_by > kRounding * std::max(1.0, std::abs(*urdf))) {
      warn("limit-exceeded", place_,
           std::string(name) + " is " + text_of(*value) + ", wider than the URDF's " +
               text_of(*urdf) + ", which counts",
           *value);
    }
    return urdf;
  }

  void settle_positions() {
    const bool endless = joint_.kind == JointKind::continuous;
    UrdfLimits& urdf = link_.limits;
    if (!endless && urdf.faults.count() == 0 && urdf.lower.has_value() != urdf.upper.has_value())
      take_zero_for_the_other(urdf);
    const auto lower = from_cell(cell_.lower, key("lower", "_rad", "_m"), urdf.lower,
                                 urdf.lower && cell_.lower && *cell_.lower < *urdf.lower);
    const auto upper = from_cell(cell_.upper, key("upper", "_rad", "_m"), urdf.upper,
                                 urdf.upper && cell_.upper && *cell_.upper > *urdf.upper);
    const auto lowest =
        lower ? lower
              : from_file(file_.lower, "min_position", urdf.lower,
                          urdf.lower && file_.lower ? *urdf.lower - *file_.lower : 0.0);
    const auto highest =
        upper ? upper
              : from_file(file_.upper, "max_position", urdf.upper,
                          urdf.upper && file_.upper ? *file_.upper - *urdf.upper : 0.0);
    joint_.lower = lowest.value_or(endless ? -kInfinity : 0.0);
    joint_.upper = highest.value_or(endless ? kInfinity : 0.0);
    if (lowest && highest && joint_.lower > joint_.upper) {
      refuse_crossed();
      joint_.lower = joint_.upper = 0.0;
    } else if (!endless && !(lowest && highest)) {
      joint_.lower = joint_.upper = lowest.value_or(highest.value_or(0.0));
      need_positions(!lowest, !highest);
    }
  }

  // As the URDF specification has it, and MoveIt.
  void take_zero_for_the_other(UrdfLimits& urdf) {
    const bool lower = !urdf.lower;
    if (urdf.lower.value_or(0.0) > urdf.upper.value_or(0.0)) return;  // no range: say it
    (lower ? urdf.lower : urdf.upper) = 0.0;
    if (arm_ == nullptr) return;
    warn("missing", place_in_urdf(),
         lower ? "limit lower is missing; the URDF specification takes 0"
               : "limit upper is missing; the URDF specification takes 0",
         0.0);
  }

  void refuse_crossed() {
    const std::string sentence = "joint " + link_.joint + ": the limits leave nothing, from " +
                                 text_of(joint_.lower) + " to " + text_of(joint_.upper);
    if (cell_.lower || cell_.upper)
      return findings_.in_cell("limits-crossed", pointer_, sentence, joint_.lower);
    if (arm_ != nullptr)
      findings_.add(
          {ProblemKind::invalid, "limits-crossed", place_, place_ + ": " + sentence, joint_.lower});
  }

  void need_positions(bool lower, bool upper) {
    if (arm_ == nullptr) return;
    std::string members;
    if (lower) append(members, ", ", member(key("lower", "_rad", "_m"), "-1"));
    if (upper) append(members, ", ", member(key("upper", "_rad", "_m"), "1"));
    if (own_) return need("position", members);
    warn("missing", place_in_urdf(),
         "there are no limits of position; the gripper's joint stays at " + text_of(joint_.lower) +
             ". Else add to arm " + arm_->description->name + " \"limits\": {\"" + link_.joint +
             "\": {" + members + "}}",
         joint_.lower);
  }

  void settle_velocity() {
    const auto& urdf = link_.limits.velocity;
    const std::string name = key("velocity", "_rad_s", "_m_s");
    std::optional<double> velocity;
    if (cell_.velocity && *cell_.velocity <= 0.0)
      refuse("not-positive", name,
             " is " + text_of(*cell_.velocity) + ", it must be greater than 0", *cell_.velocity);
    else
      velocity =
          from_cell(cell_.velocity, name, urdf, urdf && cell_.velocity && *cell_.velocity > *urdf);
    if (!velocity)
      velocity = from_file(file_.velocity, "max_velocity", urdf,
                           urdf && file_.velocity ? *file_.velocity - *urdf : 0.0);
    joint_.assumed.velocity = !velocity.has_value();
    joint_.velocity_max = velocity.value_or(kDefaultVelocity);
    if (velocity || arm_ == nullptr || cell_.velocity) return;
    const std::string limit = member(name, "1");
    if (own_) return need("velocity", limit);
    warn("missing", place_in_urdf(),
         "there is no limit of velocity; for the gripper's joint 1 is taken. Else add to arm " +
             arm_->description->name + " \"limits\": {\"" + link_.joint + "\": {" + limit + "}}",
         kDefaultVelocity);
  }

  void settle_rate(const std::optional<double>& cell, const std::optional<double>& file,
                   const std::string& name, double& limit, bool& assumed) {
    assumed = !cell && !file;
    if (assumed) return;
    const double given = cell ? *cell : *file;
    if (std::isfinite(given) && given > 0.0)
      limit = given;
    else
      refuse("not-positive", name, " is " + text_of(given) + ", it must be greater than 0", given);
  }

  void settle_rates() {
    settle_rate(cell_.acceleration, file_.acceleration, key("acceleration", "_rad_s2", "_m_s2"),
                joint_.acceleration_max, joint_.assumed.acceleration);
    settle_rate(cell_.jerk, file_.jerk, key("jerk", "_rad_s3", "_m_s3"), joint_.jerk_max,
                joint_.assumed.jerk);
    joint_.brake = 2.0 * joint_.acceleration_max;
    settle_rate(cell_.brake, std::nullopt, key("brake", "_rad_s2", "_m_s2"), joint_.brake,
                joint_.assumed.brake);
  }

  [[nodiscard]] std::string place_in_urdf() const {
    return robot_.tree.file + ": joint " + link_.joint;
  }

  const RobotBuild& robot_;
  TreeLink& link_;
  Joint& joint_;
  const ArmBuild* arm_;  // none: no arm moves the joint
  bool own_;             // of the arm's group, not of its gripper
  Findings& findings_;
  JointLimitsDescription cell_;
  JointLimitsDescription file_;
  std::string pointer_;  // of the joint's limits in the cell file
  std::string place_;    // of them in joint_limits.yaml
  std::string words_;
  std::string missing_;
};

const ArmBuild* arm_of(const RobotBuild& robot, const Joint& joint) {
  const auto found = std::find_if(robot.arms.begin(), robot.arms.end(),
                                  [&](const ArmBuild& arm) { return arm.id == joint.arm; });
  return found == robot.arms.end() ? nullptr : &*found;
}

// Limits may name joints of the arm and of its gripper.
void check_names(const RobotBuild& robot, const ArmBuild& arm, const Cell& cell,
                 Findings& findings) {
  for (const auto& [name, given] : arm.description->limits) {
    const std::string pointer = arm.pointer + "/limits/" + pointer_token(name);
    const auto link = robot.tree.by_joint.find(name);
    if (link != robot.tree.by_joint.end() && robot.tree.links[link->second].held) {
      findings.warn({ProblemKind::invalid, "held-joint", pointer,
                     "arm " + arm.description->name + ": the limits of " + name +
                         " say nothing, as \"fixed\" holds it",
                     name});
      continue;
    }
    const auto joint =
        link == robot.tree.by_joint.end() ? std::nullopt : robot.joints[link->second];
    if (joint && cell.joint(*joint).arm == arm.id) continue;
    if (robot.tree.patched) continue;
    findings.in_cell("unknown-joint", pointer,
                     "arm " + arm.description->name + " has no joint " + name + " to limit", name);
  }
}

// Of a file that is behind its URDF.
void warn_of_stale_joints(const RobotBuild& robot, Findings& findings) {
  if (!robot.limits_file) return;
  std::string names;
  for (const auto& [name, joint] : robot.limits_file->joints) {
    if (robot.tree.by_joint.contains(name) || names.size() > 200) continue;
    names += (names.empty() ? "" : ", ") + name;
  }
  if (names.empty()) return;
  const std::string& file = robot.limits_file->file;
  findings.warn({ProblemKind::invalid, "unknown-name", file,
                 file + ": joints that are not in " + robot.tree.file + " are left out: " + names,
                 names});
}

void report_needs(const ArmBuild& arm, const Needs& needs, const std::string& urdf,
                  Findings& findings) {
  if (needs.members.empty()) return;
  const bool first = arm.description->limits.empty();
  findings.in_cell(
      "limits-missing", arm.pointer + (first ? "" : "/limits"),
      "arm " + arm.description->name + ": " + urdf + " gives no limit of " + needs.names +
          "; add to the arm" +
          (first ? " \"limits\": {" + needs.members + "}" : "'s \"limits\" " + needs.members) +
          ", with what the robot really allows");
}

}  // namespace

void settle_limits(RobotBuild& robot, Cell& cell, Findings& findings) {
  std::map<const ArmBuild*, Needs> needs;
  for (std::size_t i = 0; i < robot.tree.links.size(); ++i) {
    TreeLink& link = robot.tree.links[i];
    if (!robot.joints[i]) {
      findings.merge_as_warnings(std::move(link.limits.faults));
      continue;
    }
    Joint& joint = cell.joints[robot.joints[i]->index()];
    const ArmBuild* arm = arm_of(robot, joint);
    const bool own =
        arm != nullptr && std::find(arm->group.begin(), arm->group.end(), i) != arm->group.end();
    LimitsFile::Joint* filed = nullptr;
    if (robot.limits_file) {
      const auto found = robot.limits_file->joints.find(link.joint);
      if (found != robot.limits_file->joints.end()) filed = &found->second;
    }
    LimitsOfJoint(robot, link, joint, arm, own, findings).settle(filed, needs[arm]);
  }
  for (const ArmBuild& arm : robot.arms) {
    check_names(robot, arm, cell, findings);
    report_needs(arm, needs[&arm], robot.tree.file, findings);
  }
  warn_of_stale_joints(robot, findings);
}

}  // namespace armloom
