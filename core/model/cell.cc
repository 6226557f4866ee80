#include "core/model/cell.h"

#include <algorithm>

namespace armloom {
namespace {

template <class Id, class Things>
std::optional<Id> find_by_name(const Things& things, std::string_view name) {
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].name == name) return Id(static_cast<std::uint32_t>(i));
  }
  return std::nullopt;
}

// Returns true if the parent of `carried` is static, and this parent is `mount` or is fixed to
// `mount` through links without shapes.
bool stands_on(const Cell& cell, const Link& carried, LinkId mount) {
  if (!carried.parent || cell.link(*carried.parent).arm) return false;
  for (auto below = carried.parent; below; below = cell.link(*below).parent) {
    if (*below == mount) return true;
    if (!cell.link(*below).shapes.empty() || cell.link(*below).driver) return false;
  }
  return false;
}

}  // namespace

std::optional<ArmId> Cell::find_arm(std::string_view arm_name) const {
  return find_by_name<ArmId>(arms, arm_name);
}
std::optional<JointId> Cell::find_joint(std::string_view joint_name) const {
  return find_by_name<JointId>(joints, joint_name);
}
std::optional<LinkId> Cell::find_link(std::string_view link_name) const {
  return find_by_name<LinkId>(links, link_name);
}

bool Cell::is_mount(LinkId link, ArmId arm) const {
  if (this->link(link).arm) return false;
  return std::ranges::any_of(links, [&](const Link& carried) {
    return carried.arm == arm && stands_on(*this, carried, link);
  });
}

bool Cell::is_own(LinkId a, LinkId b) const {
  return link(a).arm.has_value() && link(a).arm == link(b).arm;
}

Configuration Cell::home() const {
  Configuration q(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    q[static_cast<Eigen::Index>(j)] = std::clamp(joints[j].start, joints[j].lower, joints[j].upper);
  }
  for (const Arm& each : arms) {
    for (std::size_t j = 0; j < each.joints.size(); ++j) {
      q[static_cast<Eigen::Index>(each.joints[j].index())] =
          each.home[static_cast<Eigen::Index>(j)];
    }
  }
  return q;
}

}  // namespace armloom
