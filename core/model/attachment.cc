#include "core/model/attachment.h"

#include <algorithm>

namespace armloom {

std::vector<bool> hand_of(const Cell& cell, LinkId carrier) {
  const std::vector<JointId>& gripper = cell.arm(*cell.link(carrier).arm).gripper_joints;
  // For each link: the topmost link that it reaches through fixed joints and joints of `gripper`
  // only. One pass suffices, because parents come before their children.
  std::vector<LinkId> top;
  for (std::uint32_t i = 0; i < cell.links.size(); ++i) {
    const Link& link = cell.links[i];
    const bool joined = !link.driver || std::ranges::find(gripper, *link.driver) != gripper.end();
    top.push_back(link.parent && joined ? top[link.parent->index()] : LinkId{i});
  }
  std::vector<bool> hand;
  for (const LinkId id : top) hand.push_back(id == top[carrier.index()]);
  return hand;
}

}  // namespace armloom
