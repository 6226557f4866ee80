#include "server/import/one_arm.h"

#include <algorithm>

#include "server/import/joint_sets.h"

namespace armloom {
namespace {

// Returns the largest piece that contains the joint. A piece is a set of joints in a chain
// (pieces_of()).
const JointSet& piece_with(const std::vector<JointSet>& pieces, std::size_t joint) {
  return *std::ranges::max_element(
      pieces, {}, [&](const JointSet& piece) { return piece.contains(joint) ? piece.size() : 0; });
}

// Returns the pieces of a group: the candidates that it contains and, if the SRDF names subgroups
// of it, the set of its other joints. Returns no piece if it names none but has other joints, or if
// these belong to a group that is no arm (an end effector, a torso).
std::vector<JointSet> pieces_of(const GroupChoice& whole, const RobotSemantics& semantics,
                                const GroupNames& names, const std::vector<GroupChoice>& choices) {
  const JointSet& joints = semantics.groups.at(whole.group);
  JointSet rest = joints;
  std::vector<JointSet> pieces;
  for (const GroupChoice& choice : choices) {
    const JointSet& part = semantics.groups.at(choice.group);
    if (!choice.is_arm || part.size() >= joints.size() || !holds(joints, part)) continue;
    for (const std::size_t joint : part) rest.erase(joint);
    pieces.push_back(part);
  }
  if (rest.empty()) return pieces;
  const bool is_of_others = std::ranges::any_of(choices, [&](const GroupChoice& choice) {
    const JointSet& other = semantics.groups.at(choice.group);
    return !choice.is_arm && holds(joints, other) && share_a_joint(other, rest);
  });
  if (!names.parts.contains(whole.group) || is_of_others) return {};
  pieces.push_back(std::move(rest));
  return pieces;
}

}  // namespace

bool is_one_arm(const GroupChoice& whole, const RobotTree& tree, const RobotSemantics& semantics,
                const GroupNames& names, const std::vector<GroupChoice>& choices) {
  const JointSet& joints = semantics.groups.at(whole.group);
  if (!is_chain(tree, joints)) return false;
  const auto pieces = pieces_of(whole, semantics, names, choices);
  if (pieces.size() < 2) return false;
  const auto largest = std::ranges::max(pieces, {}, &JointSet::size).size();
  const auto is_small = [&](const JointSet& piece) { return 2 * piece.size() < largest; };
  const JointSet& last = piece_with(pieces, *joints.rbegin());
  // A small last piece may be a wrist or a gripper. A wrist moves another group (the gripper); a
  // gripper moves none.
  const bool moves_others = std::ranges::any_of(semantics.groups, [&](const auto& group) {
    return !group.second.empty() && !share_a_joint(joints, group.second) &&
           is_above(tree, last, group.second);
  });
  if (is_small(last) && !moves_others) return false;
  return names.parts.contains(whole.group) || !is_small(piece_with(pieces, *joints.begin()));
}

}  // namespace armloom
