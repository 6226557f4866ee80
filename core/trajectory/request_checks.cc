#include "core/trajectory/request_checks.h"

#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "core/base/nearest_name.h"

namespace armloom {
namespace {

void check_complete(const Cell& cell, const std::vector<ArmId>& arms,
                    const std::set<JointId>& named, ProblemList& problems) {
  for (const ArmId arm : arms) {
    for (const JointId id : cell.arm(arm).joints) {
      if (named.contains(id)) continue;
      problems.add({ProblemKind::invalid, "missing-joint", "/joint_names",
                    "joint " + cell.joint(id).name + " of arm " + cell.arm(arm).name +
                        " is missing; a motion names every joint of each arm that it moves",
                    static_cast<double>(named.size())});
    }
  }
}

// Returns a remedy if the name with a robot's prefix is a joint: it lists these joints, and says
// how to name the robot. Otherwise returns an empty string.
std::string with_prefix(const std::string& joint, const Cell& cell) {
  std::string found, arm;
  for (const Robot& robot : cell.robots) {
    const auto id = cell.find_joint(robot.prefix + joint);
    if (robot.prefix.empty() || !id || !cell.joint(*id).arm) continue;
    if (found.empty()) arm = cell.arm(*cell.joint(*id).arm).name;
    found += (found.empty() ? "" : " or ") + robot.prefix + joint;
  }
  if (found.empty()) return "";
  return "; write " + found + ", or name the arm whose prefix is meant (\"arm\": \"" + arm +
         "\" in the job)";
}

std::string nearest_joint(const std::string& joint, const Cell& cell) {
  std::vector<std::string_view> names;
  for (const Joint& known : cell.joints) {
    if (known.arm) names.push_back(known.name);
  }
  const auto nearest = nearest_name(joint, names);
  return nearest ? "; did you mean " + std::string(*nearest) + "?" : "";
}

std::string why_it_does_not_move(const std::string& joint, const Cell& cell) {
  for (const Robot& robot : cell.robots) {
    const auto still = robot.joints_without_value.find(joint);
    if (still == robot.joints_without_value.end()) continue;
    return still->second + ", and has no value of its own: leave it out";
  }
  const std::string prefixed = with_prefix(joint, cell);
  return "is not a movable joint of the cell" +
         (prefixed.empty() ? nearest_joint(joint, cell) : prefixed);
}

}  // namespace

std::string pointer_to(const TrajectoryRequest& request, std::size_t waypoint) {
  const bool skips = request.has_implicit_start && waypoint > 0;
  return "/points/" + std::to_string(waypoint - (skips ? 1 : 0));
}

std::string waypoint(const TrajectoryRequest& request, std::size_t index) {
  if (!request.has_implicit_start) return "waypoint " + std::to_string(index);
  if (index == 0) return "the arm's position at the start";
  return "waypoint " + std::to_string(index - 1);
}

std::string before_waypoint(const TrajectoryRequest& request, std::size_t index) {
  if (request.has_implicit_start && index == 1) {
    return "between the arm's position at the start and waypoint 0";
  }
  const std::size_t last = index - (request.has_implicit_start ? 1 : 0);
  return "between waypoints " + std::to_string(last - 1) + " and " + std::to_string(last);
}

std::optional<JointId> find_joint(const std::string& name, const std::string& arm,
                                  const Cell& cell) {
  if (const auto id = cell.find_joint(name)) return id;
  const auto prefixed = cell.find_arm(arm);
  if (!prefixed) return std::nullopt;
  return cell.find_joint(cell.robots[cell.arm(*prefixed).robot.index()].prefix + name);
}

Names resolve_names(const TrajectoryRequest& request, const Cell& cell, ProblemList& problems) {
  Names names;
  if (request.joint_names.empty()) {
    problems.add({ProblemKind::invalid, "empty-trajectory", "/joint_names",
                  "joint_names is empty: name the joints in the order of positions", 0.0});
  }
  std::set<JointId> named;
  std::set<ArmId> arms;
  for (std::size_t i = 0; i < request.joint_names.size() && !problems.full(); ++i) {
    const std::string& name = request.joint_names[i];
    const auto refuse = [&](const char* slug, const std::string& why) {
      problems.add({ProblemKind::invalid, slug, "/joint_names/" + std::to_string(i),
                    "joint " + name + " " + why, name});
    };
    const std::optional<JointId> id = find_joint(name, request.arm, cell);
    if (!id) {
      refuse("unknown-joint", why_it_does_not_move(name, cell));
    } else if (!cell.joint(*id).arm) {
      refuse(
          "joint-of-no-arm",
          "is in no arm's group of the cell, so nothing can move it: list it in the group, or let "
          "the cell hold it (\"fixed\")");
    } else if (!named.insert(*id).second) {
      refuse("duplicate-joint", "is named twice");
    } else {
      names.joints.push_back(*id);
      arms.insert(*cell.joint(*id).arm);
    }
  }
  names.arms.assign(arms.begin(), arms.end());
  check_complete(cell, names.arms, named, problems);
  return names;
}

bool check_count(const TrajectoryRequest& request, ProblemList& problems) {
  const std::size_t count = request.points.size();
  if (count == 0) {
    problems.add({ProblemKind::invalid, "empty-trajectory", "/points",
                  "points is empty: give at least one waypoint (positions, time_from_start)", 0.0});
  } else if (count == 1) {
    problems.add(
        {ProblemKind::invalid, "too-few-points", "/points",
         "1 waypoint makes no motion; at least 2 are needed: insert the position where the "
         "arm will be, or send the waypoint as a goal, \"move_to\": {\"joints\": [...]}, "
         "for which the server plans the path",
         1.0});
  } else if (count > kWaypointsMax) {
    problems.add({ProblemKind::too_large, "too-many-points", "/points",
                  std::to_string(count) + " waypoints are more than " +
                      std::to_string(kWaypointsMax) +
                      ": sample the path more coarsely, or send it in parts (\"after\")",
                  static_cast<double>(count)});
  } else {
    return true;
  }
  return false;
}

void check_numbers(std::size_t k, const char* member, const std::vector<double>& numbers,
                   const TrajectoryRequest& request, ProblemList& problems) {
  const std::size_t expected = request.joint_names.size();
  if (numbers.size() != expected) {
    problems.add({ProblemKind::invalid, "size-mismatch", pointer_to(request, k) + "/" + member,
                  waypoint(request, k) + ": " + std::to_string(numbers.size()) + " " + member +
                      " for " + std::to_string(expected) +
                      " joints: give one for each of joint_names",
                  static_cast<double>(numbers.size())});
    return;
  }
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    if (std::isfinite(numbers[j])) continue;
    problems.add({ProblemKind::invalid, "not-finite",
                  pointer_to(request, k) + "/" + member + "/" + std::to_string(j),
                  waypoint(request, k) + ", " + request.joint_names[j] + ": " +
                      to_text(numbers[j]) + " in " + member + " is not a finite number",
                  to_text(numbers[j])});
  }
}

}  // namespace armloom
