#include <algorithm>

#include "core/model/cell/cell_checks.h"
#include "core/model/cell/robot_build.h"

namespace armloom {

namespace {

bool of_two_arms(const Cell& cell, LinkId a, LinkId b) {
  const auto& arm_a = cell.link(a).arm;
  const auto& arm_b = cell.link(b).arm;
  return arm_a && arm_b && arm_a != arm_b;
}

// An arm with a table, say: no part of what the arm is mounted on.
bool of_arm_and_scene(const Cell& cell, LinkId a, LinkId b) {
  if (cell.link(b).arm) std::swap(a, b);
  const auto& arm = cell.link(a).arm;
  return arm && !cell.link(b).arm && !cell.is_mount(b, *arm);
}

// The Setup Assistant disables what did not meet in its random samples: between two arms, or an arm
// and what stands beside it, that is no proof.
struct DoubtfulPairs {
  bool (*concerned)(const Cell& cell, LinkId a, LinkId b);
  const char* whose;
  const char* consequence;
};
void warn_of_pairs(const RobotBuild& robot, const Cell& cell, const DoubtfulPairs& doubtful,
                   Diagnostics& diagnostics) {
  constexpr std::size_t kTold = 3;
  std::string pairs;
  std::size_t count = 0;
  for (const auto& [pair, line] : robot.semantics->allowed_pairs) {
    const LinkId a = robot.links[pair.first];
    const LinkId b = robot.links[pair.second];
    if (!doubtful.concerned(cell, a, b) || cell.link(a).shapes.empty() ||
        cell.link(b).shapes.empty()) {
      continue;
    }
    if (++count > kTold) continue;
    pairs += (pairs.empty() ? "" : ", ") + robot.tree.links[pair.first].name + " and " +
             robot.tree.links[pair.second].name + " at line " + std::to_string(line);
  }
  if (count == 0) return;
  if (count > kTold) pairs += ", ...";
  const std::string place = robot.semantics->file + ": disable_collisions";
  diagnostics.warn({ProblemKind::invalid, "unchecked-pairs", place,
                    place + ": " + std::to_string(count) + (count == 1 ? " pair" : " pairs") +
                        doubtful.whose + " (" + pairs + "): they are not checked, so " +
                        doubtful.consequence +
                        " there; delete what is not known to be out of reach",
                    static_cast<double>(count)});
}

}  // namespace

void allow_pairs_of_robot(const RobotBuild& robot, Cell& cell, Diagnostics& diagnostics) {
  const auto allow = [&](std::size_t a, std::size_t b) {
    cell.allowed.link_pairs.insert(std::minmax(robot.links[a], robot.links[b]));
  };
  std::map<std::size_t, std::vector<std::size_t>>
      bodies;  // first link of a rigid body -> its links
  std::vector<std::size_t> body_of;
  for (std::size_t i = 0; i < robot.tree.links.size(); ++i) {
    const TreeLink& link = robot.tree.links[i];
    body_of.push_back(link.parent && link.is_rigid() ? body_of[*link.parent] : i);
    auto& body = bodies[body_of.back()];
    for (const std::size_t other : body) allow(other, i);
    body.push_back(i);
    if (!robot.semantics && link.parent) allow(*link.parent, i);
  }
  if (!robot.semantics) return;
  for (const auto& [pair, line] : robot.semantics->allowed_pairs) allow(pair.first, pair.second);
  if (robot.tree.patched) return;
  warn_of_pairs(robot, cell, {of_two_arms, " of links of different arms", "these arms may meet"},
                diagnostics);
  warn_of_pairs(
      robot, cell,
      {of_arm_and_scene, " of an arm's link and one that stands still", "the arm may meet it"},
      diagnostics);
}

void allow_pairs_of_cell(const CellDescription& description, Cell& cell, Diagnostics& diagnostics) {
  const auto is_object = [&](const std::string& name) {
    return std::any_of(description.objects.begin(), description.objects.end(),
                       [&](const ObjectDescription& object) { return object.name == name; });
  };
  for (std::size_t i = 0; i < description.allowed_collisions.size(); ++i) {
    const auto& [first, second] = description.allowed_collisions[i];
    const std::string pointer = "/allowed_collisions/" + std::to_string(i);
    const auto a = cell.find_link(first);
    const auto b = cell.find_link(second);
    const bool a_object = !a && is_object(first);
    const bool b_object = !b && is_object(second);
    if (!a && !a_object) {
      diagnostics.in_cell("unknown-name", pointer + "/0",
                          "allowed collision: there is no link or object " + first, first);
    }
    if (!b && !b_object) {
      diagnostics.in_cell("unknown-name", pointer + "/1",
                          "allowed collision: there is no link or object " + second, second);
    }
    if (a_object && b_object) {
      diagnostics.in_cell("two-objects", pointer,
                          "allowed collision: " + first + " and " + second +
                              " are both objects, which are never checked against each other",
                          first);
    } else if (a && b && a == b) {
      diagnostics.in_cell("same-link", pointer, "allowed collision: " + first + " is named twice",
                          first);
    } else if (a && b) {
      cell.allowed.link_pairs.insert(std::minmax(*a, *b));
    } else if (a && b_object) {
      cell.allowed.link_objects.emplace(*a, second);
    } else if (b && a_object) {
      cell.allowed.link_objects.emplace(*b, first);
    }
  }
}

}  // namespace armloom
