#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/model/cell/robot_build.h"

namespace armloom {
namespace {

std::string span_text(const Joint& joint) {
  return "[" + text_of(joint.lower) + ", " + text_of(joint.upper) + "] " + joint.unit();
}

void warn_if_held_elsewhere(const RobotBuild& robot, const ArmBuild& build, std::size_t index,
                            double value, Diagnostics& diagnostics) {
  const TreeLink& link = robot.tree.links[index];
  if (!link.joint.held || std::abs(*link.joint.held - value) <= 1e-6) return;
  diagnostics.warn({ProblemKind::invalid, "fixed-joint", build.pointer + "/home",
                    "arm " + build.description->name + ": home has joint " + link.joint.name +
                        " at " + text_of(value) + ", but \"fixed\" holds it at " +
                        text_of(*link.joint.held) + "; the fixed value applies",
                    value});
}

// Returns the state's joint positions in the arm's order. Adds the reasons why the state cannot be
// a home to state.faults.
Eigen::VectorXd values_of(const RobotBuild& robot, const ArmBuild& arm, const std::string& name,
                          NamedState& state, const Cell& cell) {
  const auto& joints = cell.arm(arm.id).joints;
  const std::string& place = state.place;
  const auto fault = [&](const char* slug, const std::string& sentence, double value) {
    state.faults.add({ProblemKind::invalid, slug, place, place + ": " + sentence, value});
  };
  Eigen::VectorXd values(static_cast<Eigen::Index>(joints.size()));
  Eigen::Index row = 0;
  for (const std::size_t index : arm.group) {
    if (!robot.joints[index]) {  // fixed
      const auto value = state.values.find(index);
      if (value != state.values.end() && name == arm.description->home_state)
        warn_if_held_elsewhere(robot, arm, index, value->second, state.faults);
      continue;
    }
    const Joint& joint = cell.joint(*robot.joints[index]);
    const std::string& plain = robot.tree.links[index].joint.name;
    const auto value = state.values.find(index);
    values[row++] = value == state.values.end() ? 0.0 : value->second;
    if (value == state.values.end()) {
      if (state.unread.contains(index)) continue;  // already reported
      state.faults.add({ProblemKind::invalid,
                        "missing",
                        place,
                        place + ": joint " + plain + " has no value; add to it <joint name=\"" +
                            plain + "\" value=\"...\"/>",
                        {}});
    } else if (value->second < joint.lower || value->second > joint.upper) {
      fault("limit-exceeded",
            "joint " + plain + " is at " + text_of(value->second) + ", outside [" +
                text_of(joint.lower) + ", " + text_of(joint.upper) + "]",
            value->second);
    }
  }
  return values;
}

// Returns the states that apply to the arm: those of its group, and those of other groups that give
// a position to each of its joints (both_arms). Of several states with one name, the arm's own
// group comes first, then the group with the fewest joints.
std::map<std::string, NamedState> states_of(const RobotBuild& robot, const ArmBuild& build) {
  const RobotSemantics& semantics = *robot.semantics;
  std::map<std::string, NamedState> states;
  std::vector<std::string> others;
  for (const auto& [group, of_group] : semantics.states) {
    if (group == build.description->group)
      states = of_group;
    else
      others.push_back(group);
  }
  std::ranges::stable_sort(
      others, {}, [&](const std::string& group) { return semantics.groups.at(group).size(); });
  const auto has_all = [&](const NamedState& state) {
    return std::ranges::all_of(build.group, [&](std::size_t index) {
      return !robot.joints[index] || state.values.contains(index);
    });
  };
  for (const std::string& group : others) {
    for (const auto& [name, state] : semantics.states.at(group)) {
      if (has_all(state)) states.emplace(name, state);
    }
  }
  return states;
}

// Adds the named states without faults to the arm. Faults of the state that is the arm's home are
// problems; faults of other states are warnings.
void read_named_states(const RobotBuild& robot, const ArmBuild& build,
                       std::map<std::string, NamedState>& states, Cell& cell,
                       Diagnostics& diagnostics) {
  for (auto& [name, state] : states) {
    Eigen::VectorXd values = values_of(robot, build, name, state, cell);
    if (state.faults.count() == 0)
      cell.arms[build.id.index()].named_states.emplace(name, std::move(values));
    if (name == build.description->home_state)
      diagnostics.merge(std::move(state.faults));
    else
      diagnostics.merge_as_warnings(std::move(state.faults));
  }
}

// Adds the states of any group that give positions, within the limits, of gripper joints of this
// arm only. Joints that follow others have no value of their own.
void read_gripper_states(const RobotBuild& robot, Arm& arm, const Cell& cell) {
  for (const auto& [group, states] : robot.semantics->states) {
    for (const auto& [name, state] : states) {
      std::map<JointId, double> positions;
      bool is_gripper = true;
      for (const auto& [index, value] : state.values) {
        const std::optional<JointId> joint = robot.joints[index];
        if (!joint) continue;
        is_gripper = is_gripper && std::ranges::count(arm.gripper_joints, *joint) > 0 &&
                     value >= cell.joint(*joint).lower && value <= cell.joint(*joint).upper;
        positions.emplace(*joint, value);
      }
      if (is_gripper && !positions.empty()) arm.gripper_states.emplace(name, std::move(positions));
    }
  }
}

std::string listed(const std::map<std::string, NamedState>& states) {
  std::string text;
  for (const auto& [name, state] : states) {
    if (text.size() < 200) text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "none" : text;
}

// Reports a home that names an unknown state. The faults of a known state were reported before.
void refuse_unknown_state(const RobotBuild& robot, const ArmDescription& arm,
                          const std::string& pointer,
                          const std::map<std::string, NamedState>& states,
                          Diagnostics& diagnostics) {
  if (states.contains(arm.home_state)) return;
  diagnostics.in_cell("unknown-state", pointer + "/home",
                      "arm " + arm.name + ": home '" + arm.home_state +
                          "' is not a state of group '" + arm.group + "'" +
                          (robot.semantics ? " in " + robot.semantics->file : "") +
                          "; its states: " + listed(states),
                      arm.home_state);
}

// If the URDF could not be read, reports the faults of the SRDF's states, and homes that name an
// unknown state.
void tell_homes_without_tree(RobotBuild& robot, Diagnostics& diagnostics) {
  if (!robot.semantics) return;
  const auto& arms = robot.description->arms;
  for (std::size_t a = 0; a < arms.size(); ++a) {
    const ArmDescription& arm = arms[a];
    if (!robot.semantics->groups.contains(arm.group)) continue;  // already reported
    for (auto& [name, state] : robot.semantics->states[arm.group]) {
      if (name == arm.home_state)
        diagnostics.merge(std::exchange(state.faults, {}));
      else
        diagnostics.merge_as_warnings(std::exchange(state.faults, {}));
    }
    // A state of another group may apply to the arm.
    const bool is_known = std::ranges::any_of(robot.semantics->states, [&](const auto& of_group) {
      return of_group.second.contains(arm.home_state);
    });
    if (arm.home_state.empty() || is_known) continue;
    refuse_unknown_state(robot, arm, robot.pointer + "/arms/" + std::to_string(a),
                         robot.semantics->states[arm.group], diagnostics);
  }
}

// Returns the positions of the named state that is the arm's home. If the state is unusable,
// returns nullopt; the faults are reported.
std::optional<Eigen::VectorXd> named_home(const RobotBuild& robot, const ArmBuild& build,
                                          const Arm& arm,
                                          const std::map<std::string, NamedState>& states,
                                          Diagnostics& diagnostics) {
  const std::string& name = build.description->home_state;
  const auto state = arm.named_states.find(name);
  if (state != arm.named_states.end()) return state->second;
  refuse_unknown_state(robot, *build.description, build.pointer, states, diagnostics);
  return std::nullopt;
}

// Returns the home that the cell file lists as positions, which may include the fixed joints. If
// the list has faults, reports them and returns nullopt.
std::optional<Eigen::VectorXd> listed_home(const RobotBuild& robot, const ArmBuild& build,
                                           const Arm& arm, Diagnostics& diagnostics) {
  const std::vector<double>& home = build.description->home;
  std::vector<double> values;
  if (home.size() == arm.joints.size()) {
    values = home;
  } else if (home.size() == build.group.size()) {
    for (std::size_t j = 0; j < home.size(); ++j) {
      if (robot.joints[build.group[j]])
        values.push_back(home[j]);
      else
        warn_if_held_elsewhere(robot, build, build.group[j], home[j], diagnostics);
    }
  } else {
    std::string names;
    for (const std::size_t joint : build.group) {
      if (robot.joints[joint])
        names += (names.empty() ? "" : ", ") + robot.tree.links[joint].joint.name;
    }
    diagnostics.in_cell("wrong-size", build.pointer + "/home",
                        "arm " + arm.name + ": home has " + std::to_string(home.size()) +
                            " values, the group has " + std::to_string(arm.joints.size()) +
                            " joints; give one value for each of " + names +
                            (robot.semantics ? ", or the name of a state" : ""),
                        static_cast<double>(home.size()));
    return std::nullopt;
  }
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

void check_home(const ArmBuild& build, const Arm& arm, const Cell& cell, Diagnostics& diagnostics) {
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    const Joint& joint = cell.joint(arm.joints[j]);
    const double value = arm.home[static_cast<Eigen::Index>(j)];
    if (std::isfinite(value) && value >= joint.lower && value <= joint.upper) continue;
    diagnostics.in_cell("limit-exceeded", build.pointer + "/home/" + std::to_string(j),
                        "arm " + arm.name + ": home of " + joint.name + " is " + text_of(value) +
                            ", outside " + span_text(joint),
                        value);
  }
}

// Sets the start positions of joints that are in no arm's group.
void settle_grippers(const RobotBuild& robot, Cell& cell, Diagnostics& diagnostics) {
  for (const auto& joint : robot.joints) {
    if (!joint) continue;
    Joint& one = cell.joints[joint->index()];
    one.start = std::clamp(0.0, one.lower, one.upper);
  }
  for (const ArmBuild& build : robot.arms) {
    for (const auto& [name, value] : build.description->gripper) {
      const auto refuse = [&, &named = name, &given = value](const char* slug,
                                                             const std::string& rest) {
        diagnostics.in_cell(slug, build.pointer + "/gripper/" + pointer_token(named),
                            "arm " + build.description->name + rest, given);
      };
      const auto link = robot.tree.by_joint.find(name);
      if (link == robot.tree.by_joint.end()) {
        if (!robot.tree.nameless)
          refuse("unknown-joint",
                 ": joint " + name + " of its gripper is not in " + robot.tree.file);
        continue;
      }
      const auto joint = robot.joints[link->second];
      const auto& grippers = cell.arm(build.id).gripper_joints;
      if (!joint || std::find(grippers.begin(), grippers.end(), *joint) == grippers.end()) {
        if (!robot.tree.patched)
          refuse("unknown-joint", " has no gripper joint " + name +
                                      " (a movable joint below the arm, in no arm's group, that "
                                      "follows no other joint)");
        continue;
      }
      Joint& one = cell.joints[joint->index()];
      if (std::isfinite(value) && value >= one.lower && value <= one.upper)
        one.start = value;
      else
        refuse("limit-exceeded", ": joint " + name + " of its gripper starts at " + text_of(value) +
                                     ", outside " + span_text(one));
    }
  }
}

}  // namespace

void settle_homes(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics) {
  settle_grippers(robot, cell, diagnostics);
  if (robot.tree.patched) tell_homes_without_tree(robot, diagnostics);
  for (const ArmBuild& build : robot.arms) {
    Arm& arm = cell.arms[build.id.index()];
    arm.home = Eigen::VectorXd(static_cast<Eigen::Index>(arm.joints.size()));
    for (std::size_t j = 0; j < arm.joints.size(); ++j) {
      const Joint& joint = cell.joint(arm.joints[j]);
      arm.home[static_cast<Eigen::Index>(j)] = std::clamp(0.0, joint.lower, joint.upper);
    }
    if (robot.tree.patched) continue;  // the group may contain unintended joints
    const std::string& named = build.description->home_state;
    auto states = robot.semantics ? states_of(robot, build) : std::map<std::string, NamedState>();
    read_named_states(robot, build, states, cell, diagnostics);
    if (robot.semantics) read_gripper_states(robot, arm, cell);
    std::optional<Eigen::VectorXd> home;
    if (!named.empty())
      home = named_home(robot, build, arm, states, diagnostics);
    else if (!build.description->home.empty())
      home = listed_home(robot, build, arm, diagnostics);
    if (home) arm.home = *std::move(home);
    check_home(build, arm, cell, diagnostics);
  }
}

}  // namespace armloom
