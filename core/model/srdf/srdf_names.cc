#include "core/model/srdf/srdf_names.h"

#include <tinyxml2.h>

#include <string_view>

namespace armloom {
namespace {

using tinyxml2::XMLElement;

// An attribute that names a joint or link of the URDF.
struct NamingAttribute {
  std::string_view parent;  // tag of the parent element
  std::string_view tag;
  const char* attribute;
  bool is_link;
};
constexpr NamingAttribute kNaming[] = {
    {"group", "joint", "name", false},
    {"group", "link", "name", true},
    {"group", "chain", "base_link", true},
    {"group", "chain", "tip_link", true},
    {"group_state", "joint", "name", false},
    {"robot", "passive_joint", "name", false},
    {"robot", "joint_property", "joint_name", false},
    {"robot", "virtual_joint", "child_link", true},
    {"robot", "end_effector", "parent_link", true},
    {"robot", "link_sphere_approximation", "link", true},
    {"robot", "disable_default_collisions", "link", true},
    {"robot", "disable_collisions", "link1", true},
    {"robot", "disable_collisions", "link2", true},
    {"robot", "enable_collisions", "link1", true},
    {"robot", "enable_collisions", "link2", true},
};

std::set<std::string> virtual_joints_of(const XMLElement& srdf) {
  std::set<std::string> names;
  for (const auto* joint = srdf.FirstChildElement("virtual_joint"); joint != nullptr;
       joint = joint->NextSiblingElement("virtual_joint")) {
    if (const char* name = joint->Attribute("name")) names.insert(name);
  }
  return names;
}

// Visits (element, attribute, value) of each name of a joint or link.
template <class Element, class Visit>
void for_each_name(Element& parent, const std::set<std::string>& virtual_joints,
                   const Visit& visit) {
  for (auto* child = parent.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    for (const NamingAttribute& naming : kNaming) {
      if (naming.tag != child->Name() || naming.parent != parent.Name()) continue;
      const char* value = child->Attribute(naming.attribute);
      if (value == nullptr || *value == '\0') continue;
      if (!naming.is_link && virtual_joints.contains(value)) continue;
      visit(*child, naming, std::string(value));
    }
    for_each_name(*child, virtual_joints, visit);
  }
}

}  // namespace

SrdfNames names_in_srdf(const XMLElement& srdf) {
  SrdfNames names;
  for_each_name(srdf, virtual_joints_of(srdf),
                [&](const XMLElement&, const NamingAttribute& naming, const std::string& name) {
                  (naming.is_link ? names.links : names.joints).insert(name);
                });
  return names;
}

void prepend_to_names(const std::string& prefix, XMLElement& srdf) {
  if (prefix.empty()) return;
  for_each_name(srdf, virtual_joints_of(srdf),
                [&](XMLElement& element, const NamingAttribute& naming, const std::string& name) {
                  element.SetAttribute(naming.attribute, (prefix + name).c_str());
                });
}

}  // namespace armloom
