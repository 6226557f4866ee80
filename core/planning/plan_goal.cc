#include "core/planning/plan_goal.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/add_below.h"
#include "core/base/nearest_name.h"

namespace armloom {
namespace {

tl::unexpected<Problems> fault(const char* slug, std::string pointer, std::string detail,
                               const std::string& value) {
  return failure(Problem{ProblemKind::invalid, slug, std::move(pointer), std::move(detail), value});
}

std::string names_of_arms(const Cell& cell) {
  std::string names;
  for (const Arm& arm : cell.arms) names += (names.empty() ? "" : ", ") + arm.name;
  return names;
}

Result<Eigen::VectorXd> named_state(const Arm& arm, const std::string& name) {
  if (const auto state = arm.named_states.find(name); state != arm.named_states.end()) {
    return state->second;
  }
  if (name == "home") return arm.home;
  std::string known = "home";
  for (const auto& [state, q] : arm.named_states) {
    if (state != "home") known += ", " + state;
  }
  for (const auto& [state, positions] : arm.gripper_states)
    known += ", " + state + " (of the gripper: in a job for one \"arm\")";
  return fault("unknown-state", "/named",
               "arm " + arm.name + " has no named state " + name +
                   did_you_mean(name, arm.named_states) + "; it has " + known,
               name);
}

std::string gripper_remedy(const Cell& cell, const Arm& arm) {
  if (arm.gripper_joints.empty()) return "";
  return "; gripper joints are given by name: {\"" + cell.joint(arm.gripper_joints.front()).name +
         "\": ...}";
}

// Returns the names of the arm's links: "left_link1, left_link2".
std::string links_of(const Cell& cell, const Arm& arm) {
  std::string links;
  for (const LinkId link : arm.links) links += (links.empty() ? "" : ", ") + cell.link(link).name;
  return links;
}

// Returns the arm's links by name, both with and without the robot's prefix.
std::map<std::string, LinkId> names_of_links(const Cell& cell, const Arm& arm) {
  std::map<std::string, LinkId> names;
  for (const LinkId link : arm.links) {
    const std::string& name = cell.link(link).name;
    names.emplace(name, link);
    names.emplace(name.substr(cell.robots[arm.robot.index()].prefix.size()), link);
  }
  return names;
}

Result<LinkTarget> target_of(const Cell& cell, const Arm& arm, const PlanPose& pose) {
  if (pose.link) {
    if (const auto link = cell.find_link(*pose.link)) return LinkTarget{*link, pose.X_WL};
    const auto own = cell.find_link(cell.robots[arm.robot.index()].prefix + *pose.link);
    if (own) return LinkTarget{*own, pose.X_WL};
    return fault("unknown-link", "/pose/link",
                 "the cell has no link " + *pose.link +
                     did_you_mean(*pose.link, names_of_links(cell, arm)) + "; arm " + arm.name +
                     " moves " + links_of(cell, arm),
                 *pose.link);
  }
  const auto last = std::ranges::find_if(
      arm.links, [&](LinkId id) { return cell.link(id).driver == arm.joints.back(); });
  return LinkTarget{*last, pose.X_WL};
}

// Returns the named arms that the cell has, each once. Reports names that are unknown or repeated.
std::vector<std::pair<std::string, ArmId>> arms_of(const Cell& cell, const GoalArms& who,
                                                   Problems& problems) {
  std::vector<std::pair<std::string, ArmId>> arms;  // place of the name, arm
  const auto add = [&](std::string place, const std::string& name) {
    auto arm = find_arm(cell, name);
    if (!arm) return add_below(place, std::move(arm.error()), problems);
    const auto same = [&](const auto& other) { return other.second == *arm; };
    if (std::ranges::none_of(arms, same)) return arms.emplace_back(std::move(place), *arm), void();
    problems.push_back({ProblemKind::invalid, "arm-twice", std::move(place),
                        "arm " + name + " is named twice", name});
  };
  if (who.arms.empty() && who.arm.empty()) {
    problems.push_back(
        {ProblemKind::invalid,
         "no-arm",
         "/arm",
         "no arm is given: name one in arm, or several candidates in arms; the cell has " +
             names_of_arms(cell),
         {}});
    return arms;
  }
  if (who.arms.empty()) {
    add("/arm", who.arm);
    return arms;
  }
  if (!who.arm.empty()) {
    problems.push_back({ProblemKind::invalid, "not-both", "/arms",
                        "both arm and arms are given: give only one of them", who.arm});
  }
  for (std::size_t i = 0; i < who.arms.size(); ++i) add("/arms/" + std::to_string(i), who.arms[i]);
  return arms;
}

// Reports a goal link that the arm does not move. The remedy depends on whether `place` is that of
// a candidate arm or of the link.
void find_link_of_another(const Cell& cell, const MotionGoal& goal, const std::string& place,
                          Problems& problems) {
  const auto* target = std::get_if<LinkTarget>(&goal.to);
  const Arm& arm = cell.arm(goal.arm);
  if (target == nullptr || std::ranges::find(arm.links, target->link) != arm.links.end()) return;
  const std::string& link = cell.link(target->link).name;
  const std::string remedy = place.starts_with("/arms")
                                 ? ": name the link without its prefix, so that it fits each arm, "
                                   "or name no link"
                                 : "; it moves " + links_of(cell, arm);
  problems.push_back({ProblemKind::invalid, "link-of-another-arm", place,
                      "arm " + arm.name + " does not move " + link + remedy, link});
}

}  // namespace

Result<ArmId> find_arm(const Cell& cell, const std::string& name) {
  if (const auto arm = cell.find_arm(name)) return *arm;
  return fault("unknown-arm", "", "the cell has no arm " + name + "; it has " + names_of_arms(cell),
               name);
}

Result<Eigen::VectorXd> joints_of(const Cell& cell, ArmId id, const PlanGoal& said) {
  const Arm& arm = cell.arm(id);
  if (said.named) return named_state(arm, *said.named);
  if (!said.gripper.empty()) {
    return fault("not-served", "/joints",
                 "gripper joints move by a job for one \"arm\": send it as POST /jobs, or give the "
                 "positions of the arm's joints as a list",
                 said.gripper.begin()->first);
  }
  if (!said.joints) {
    return fault("not-served", "/pose",
                 "a pose does not define the position of each joint: give joints or a named state",
                 "pose");
  }
  if (said.joints->size() != arm.joints.size()) {
    return fault("size-mismatch", "/joints",
                 "arm " + arm.name + " has " + std::to_string(arm.joints.size()) +
                     " joints, found " + std::to_string(said.joints->size()) + " positions" +
                     gripper_remedy(cell, arm),
                 std::to_string(said.joints->size()));
  }
  return Eigen::Map<const Eigen::VectorXd>(said.joints->data(),
                                           static_cast<Eigen::Index>(said.joints->size()));
}

Result<MotionGoal> goal_of(const Cell& cell, ArmId arm, const PlanGoal& said) {
  if (said.pose) {
    auto target = target_of(cell, cell.arm(arm), *said.pose);
    if (!target) return failure(std::move(target.error()));
    return MotionGoal{.arm = arm,
                      .to = *std::move(target),
                      .speed = cell.execution.velocity_scaling_factor,
                      .straight = said.cartesian};
  }
  auto q = joints_of(cell, arm, said);
  if (!q) return failure(std::move(q.error()));
  return MotionGoal{
      .arm = arm, .to = *std::move(q), .speed = cell.execution.velocity_scaling_factor};
}

Result<std::vector<MotionGoal>> goals_of(const Cell& cell, const GoalArms& who,
                                         const PlanGoal& said, const std::string& place) {
  Problems problems;
  std::vector<MotionGoal> goals;
  for (const auto& [place_of_arm, arm] : arms_of(cell, who, problems)) {
    auto goal = goal_of(cell, arm, said);
    if (!goal) {
      add_below(place, std::move(goal.error()), problems);
      continue;
    }
    find_link_of_another(cell, *goal, who.arms.empty() ? place + "/pose/link" : place_of_arm,
                         problems);
    goals.push_back(*std::move(goal));
  }
  if (!problems.empty()) return failure(std::move(problems));
  return goals;
}

}  // namespace armloom
