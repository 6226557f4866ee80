#include "core/model/urdf/hold_joints.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/nearest_name.h"

namespace armloom {
namespace {

struct NamedTree {
  const std::string& robot;
  const RobotTree& tree;
};

// Returns the tree index of the joint if it can be fixed. Otherwise reports the reason and returns
// nullopt. A value beyond the limits is reported and clamped.
std::optional<std::size_t> holdable(const std::string& name, double& value,
                                    const std::string& pointer, const NamedTree& of,
                                    Diagnostics& diagnostics) {
  const RobotTree& tree = of.tree;
  const auto refuse = [&](const std::string& slug, const std::string& why) {
    diagnostics.in_cell(slug, pointer, "robot " + of.robot + ": " + why, value);
    return std::nullopt;
  };
  const auto found = tree.by_joint.find(name);
  if (found == tree.by_joint.end()) {
    if (tree.nameless) return std::nullopt;
    static_cast<void>(refuse("unknown-joint", "fixed joint " + name + " is not in " + tree.file +
                                                  did_you_mean(name, tree.by_joint)));
    // Fix the joint that was probably meant, to avoid follow-up problems.
    const auto meant = nearest_key(name, tree.by_joint);
    Diagnostics unsaid;
    return meant ? holdable(*meant, value, pointer, of, unsaid) : std::nullopt;
  }
  const TreeLink& link = tree.links[found->second];
  if (link.joint.mimic) {
    return refuse("held-mimic", "joint " + name + " follows joint " +
                                    tree.links[link.joint.mimic->driver].joint.name +
                                    ": hold that joint instead");
  }
  if (link.joint.many_values)
    return refuse("unsupported-joint",
                  "joint " + name + ": floating and planar joints cannot be fixed");
  if (!link.joint.motion)
    return refuse("held-fixed", "joint " + name + " is already fixed in " + tree.file);
  if (!std::isfinite(value))
    return refuse("not-a-number",
                  "joint " + name + " is held at " + text_of(value) + ", not a finite number");
  const UrdfLimits& limits = link.joint.limits;
  if ((limits.lower && value < *limits.lower) || (limits.upper && value > *limits.upper)) {
    static_cast<void>(
        refuse("limit-exceeded", "joint " + name + " is held at " + text_of(value) + ", outside [" +
                                     (limits.lower ? text_of(*limits.lower) : "-inf") + ", " +
                                     (limits.upper ? text_of(*limits.upper) : "inf") + "]"));
    if (limits.lower) value = std::max(value, *limits.lower);
    if (limits.upper) value = std::min(value, *limits.upper);
  }
  return found->second;
}

void hold(TreeLink& link, double value) {
  if (*link.joint.motion == JointKind::prismatic)
    link.joint.X_PJ = link.joint.X_PJ * Eigen::Translation3d(link.joint.axis * value);
  else
    link.joint.X_PJ = link.joint.X_PJ * Eigen::AngleAxisd(value, link.joint.axis);
  link.joint.motion = std::nullopt;
  link.joint.mimic = std::nullopt;
  link.joint.held = value;
}

std::string text_of_vector(const Eigen::Vector3d& v) {
  return text_of(v.x()) + " " + text_of(v.y()) + " " + text_of(v.z());
}

// Returns roll, pitch and yaw about fixed axes, as in a URDF (rad). At gimbal lock, yaw is 0.
Eigen::Vector3d rpy_of(const Eigen::Matrix3d& R) {
  const double level = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), level);
  if (level < 1e-9) return {std::atan2(-R(1, 2), R(1, 1)), pitch, 0.0};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

void fix_in_text(const TreeLink& link, tinyxml2::XMLElement& joint) {
  joint.SetAttribute("type", "fixed");
  for (const char* child : {"origin", "axis", "limit", "mimic"}) {
    while (auto* element = joint.FirstChildElement(child)) joint.DeleteChild(element);
  }
  auto* origin = joint.GetDocument()->NewElement("origin");
  origin->SetAttribute("xyz",
                       text_of_vector(Eigen::Vector3d(link.joint.X_PJ.translation())).c_str());
  origin->SetAttribute("rpy", text_of_vector(rpy_of(link.joint.X_PJ.linear())).c_str());
  joint.InsertFirstChild(origin);
}

// Makes the held joints fixed in the URDF's text. Precondition: the text was parsed before without
// an error.
void fix_in_text(RobotTree& tree) {
  tinyxml2::XMLDocument document;
  if (document.Parse(tree.text.data(), tree.text.size()) != tinyxml2::XML_SUCCESS) return;
  auto* robot = document.RootElement();
  for (auto* joint = robot->FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    const char* name = joint->Attribute("name");
    const auto found = tree.by_joint.find(name == nullptr ? "" : name);
    if (found != tree.by_joint.end() && tree.links[found->second].joint.held)
      fix_in_text(tree.links[found->second], *joint);
  }
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  tree.text = printer.CStr();
}

// Returns the position at which the joint above links[index] is fixed (rad or m), or nullopt if the
// joint moves.
std::optional<double> value_held_at(const TreeLink& link, std::size_t index,
                                    const std::map<std::size_t, double>& held) {
  if (link.joint.mimic && link.joint.mimic->multiplier == 0.0) return link.joint.mimic->offset;
  const auto own = held.find(link.joint.mimic ? link.joint.mimic->driver : index);
  if (own == held.end()) return std::nullopt;
  return link.joint.mimic ? link.joint.mimic->multiplier * own->second + link.joint.mimic->offset
                          : own->second;
}

}  // namespace

void hold_joints(const std::map<std::string, double>& fixed, const std::string& pointer,
                 const std::string& robot, RobotTree& tree, Diagnostics& diagnostics) {
  std::map<std::size_t, double> held;
  for (auto [name, value] : fixed) {
    const std::string at = pointer + "/fixed/" + pointer_token(name);
    if (const auto joint = holdable(name, value, at, {robot, tree}, diagnostics))
      held.emplace(*joint, value);
  }
  bool any = false;
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    TreeLink& link = tree.links[i];
    if (!link.joint.motion) continue;
    const std::optional<double> value = value_held_at(link, i, held);
    if (!value) continue;
    hold(link, *value);
    any = true;
  }
  if (any) fix_in_text(tree);
}

}  // namespace armloom
