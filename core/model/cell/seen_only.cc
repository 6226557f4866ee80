#include "core/model/cell/robot_build.h"

namespace armloom {

void warn_of_seen_only(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics) {
  const auto tell = [&](const std::string& whose, const std::string& sentence,
                        const std::string& value) {
    const std::string place = robot.tree.file + ": " + whose;
    diagnostics.warn({ProblemKind::invalid, "no-collision", place, place + ": " + sentence, value});
  };
  std::string links;
  std::size_t more = 0;
  for (std::size_t i = 0; i < robot.tree.links.size(); ++i) {
    const TreeLink& link = robot.tree.links[i];
    if (!link.seen || link.solid) continue;
    if (links.size() < 200)
      links += (links.empty() ? "" : ", ") + link.name;
    else
      ++more;
  }
  if (more > 0) links += " and " + std::to_string(more) + " more";
  if (!links.empty()) {
    tell("links",
         links +
             " have a <visual> but no <collision>: the dashboard shows them, but they are not "
             "checked, so collisions with them are not detected; give each a <collision>, like its "
             "<visual> or simpler",
         links);
  }
  for (const ArmBuild& build : robot.arms) {
    const Arm& arm = cell.arm(build.id);
    std::size_t own = 0;  // links that the arm moves; 0 if its group belongs to another arm
    std::size_t solid = 0;
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      if (cell.link(robot.links[i]).arm != build.id) continue;
      ++own;
      solid += robot.tree.links[i].solid ? 1 : 0;
    }
    if (own > 0 && solid == 0)
      tell("arm " + arm.name,
           "no link has <collision> geometry, so its motions are not checked and it may hit "
           "anything; add <collision> elements to its links",
           arm.name);
  }
}

}  // namespace armloom
