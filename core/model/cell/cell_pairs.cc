#include <algorithm>

#include "core/model/cell/cell_checks.h"
#include "core/model/cell/robot_build.h"

namespace armloom {

namespace {

// Returns true if an SRDF that disables this pair only claims that its links cannot meet: links of
// different arms, or an arm's link and a static link that is not the arm's mount.
bool is_only_claimed(const Cell& cell, LinkId a, LinkId b) {
  const auto& arm_a = cell.link(a).arm;
  const auto& arm_b = cell.link(b).arm;
  if (arm_a && arm_b) return arm_a != arm_b;
  if (arm_a) return !cell.is_mount(b, *arm_a);
  return arm_b && !cell.is_mount(a, *arm_b);
}

}  // namespace

void allow_pairs_of_robot(const RobotBuild& robot, Cell& cell) {
  const auto allow = [&](std::size_t a, std::size_t b) {
    cell.allowed.link_pairs.insert(std::minmax(robot.links[a], robot.links[b]));
  };
  std::map<std::size_t, std::vector<std::size_t>>
      bodies;  // first link of a rigid body -> all links of that body
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
  for (const auto& [pair, line] : robot.semantics->allowed_pairs) {
    const LinkPair links = std::minmax(robot.links[pair.first], robot.links[pair.second]);
    if (!is_only_claimed(cell, links.first, links.second)) {
      cell.allowed.link_pairs.insert(links);
    } else if (!cell.link(links.first).shapes.empty() && !cell.link(links.second).shapes.empty()) {
      cell.allowed.claimed_pairs.emplace(links, robot.semantics->file + ":" + std::to_string(line));
    }
  }
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
      cell.allowed.cell_file_pairs.insert(std::minmax(*a, *b));
    } else if (a && b_object) {
      cell.allowed.link_objects.emplace(*a, second);
    } else if (b && a_object) {
      cell.allowed.link_objects.emplace(*b, first);
    }
  }
}

}  // namespace armloom
