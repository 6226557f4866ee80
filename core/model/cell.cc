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
  const auto stands_on_it = [&](const Link& carried) {
    if (carried.arm != arm || !carried.parent || this->link(*carried.parent).arm) return false;
    for (auto below = carried.parent; below; below = this->link(*below).parent) {
      if (*below == link) return true;
      if (!this->link(*below).shapes.empty() || this->link(*below).driver) return false;
    }
    return false;
  };
  return std::ranges::any_of(links, stands_on_it);
}

bool Cell::is_own(LinkId link, ArmId arm) const {
  return this->link(link).arm == arm || is_mount(link, arm);
}

Configuration Cell::home() const {
  Configuration q(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    q[static_cast<Eigen::Index>(j)] = std::clamp(0.0, joints[j].lower, joints[j].upper);
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
