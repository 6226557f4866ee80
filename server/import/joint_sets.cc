#include "server/import/joint_sets.h"

#include <algorithm>

namespace armloom {

bool share_a_joint(const JointSet& a, const JointSet& b) {
  return std::ranges::any_of(a, [&](std::size_t joint) { return b.contains(joint); });
}

bool holds(const JointSet& whole, const JointSet& part) {
  return std::ranges::includes(whole, part);
}

bool is_above(const RobotTree& tree, const JointSet& above, const JointSet& below) {
  return std::ranges::all_of(below, [&](std::size_t joint) {
    for (auto link = tree.links[joint].parent; link; link = tree.links[*link].parent) {
      if (above.contains(*link)) return true;
    }
    return false;
  });
}

bool is_chain(const RobotTree& tree, const JointSet& joints) {
  // Parents come before children in the tree.
  return std::ranges::adjacent_find(joints, [&](std::size_t upper, std::size_t lower) {
           return !is_above(tree, {upper}, {lower});
         }) == joints.end();
}

bool stand_side_by_side(const RobotTree& tree, const JointSet& a, const JointSet& b) {
  return !share_a_joint(a, b) && !is_above(tree, a, b) && !is_above(tree, b, a);
}

bool share_a_torso(const RobotTree& tree, const JointSet& a, const JointSet& b) {
  JointSet shared;
  JointSet rest_a;
  JointSet rest_b;
  for (const std::size_t joint : a) (b.contains(joint) ? shared : rest_a).insert(joint);
  for (const std::size_t joint : b) {
    if (!a.contains(joint)) rest_b.insert(joint);
  }
  return !rest_a.empty() && !rest_b.empty() && is_above(tree, shared, rest_a) &&
         is_above(tree, shared, rest_b) && stand_side_by_side(tree, rest_a, rest_b) &&
         shared.size() <= std::min(rest_a.size(), rest_b.size());
}

}  // namespace armloom
