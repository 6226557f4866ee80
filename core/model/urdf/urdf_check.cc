#include "core/model/urdf/urdf_check.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "core/model/urdf/urdf_copy.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

// An axis whose length deviates less from 1 is accepted, because its numbers were only rounded.
constexpr double kUnitAxis = 0.01;

// Narrows the limits to the soft limits of <safety_controller>, as MoveIt does.
void narrow_to_soft_limits(const XMLElement& joint, double lower, double upper,
                           const XmlPlace& place, XMLElement& limit) {
  const auto* safety = joint.FirstChildElement("safety_controller");
  if (safety == nullptr) return;
  const XmlPlace odd = place.only_warning("the <limit> applies");
  const auto soft_lower = odd.number(*safety, "soft_lower_limit", Presence::optional);
  const auto soft_upper = odd.number(*safety, "soft_upper_limit", Presence::optional);
  const double from = std::max(lower, soft_lower.value_or(lower));
  const double to = std::min(upper, soft_upper.value_or(upper));
  if (from > to || (from == to && lower < upper)) {
    odd.at(*safety).report("limits-crossed",
                           "the soft limits leave no range of the <limit>: from " + text_of(from) +
                               " to " + text_of(to),
                           from);
    return;
  }
  limit.SetAttribute("lower", text_of(from).c_str());
  limit.SetAttribute("upper", text_of(to).c_str());
}

// Checks a <limit> and copies it. Adds effort and velocity if they are missing, because urdfdom
// requires them.
void check_limit(const XMLElement& joint, std::string_view type, const XmlPlace& place,
                 UrdfNotes::Joint& notes, XMLElement& to) {
  XMLElement& copy = *to.InsertNewChildElement("limit");
  for (const char* form : {"effort", "velocity"}) copy.SetAttribute(form, "0");
  const XmlPlace faults = place.telling(notes.faults);
  const auto* limit = faults.only_child(joint, "limit", Presence::optional);
  if (limit == nullptr) return;
  faults.only_attributes(
      *limit, {"lower", "upper", "velocity", "effort", "acceleration", "deceleration", "jerk"});
  const auto number = [&](const char* attribute) {
    const auto one = copy_numbers(*limit, {attribute, 1, Presence::optional}, faults, copy);
    return one ? std::optional(one->front()) : std::nullopt;
  };
  place.only_warning("efforts play no part in the checks")
      .number(*limit, "effort", Presence::optional);
  const auto velocity = number("velocity");
  notes.velocity = velocity && *velocity > 0.0;  // 0 means no limit, as in MoveIt
  if (velocity && *velocity < 0.0)
    faults.at(*limit).report(
        "not-positive", "limit velocity is " + text_of(*velocity) + ", it must be greater than 0",
        *velocity);
  if (type == "continuous") return;  // without position limits, as in MoveIt
  const auto lower = number("lower");
  const auto upper = number("upper");
  const bool crossed = lower && upper && *lower > *upper;
  if (crossed)
    faults.at(*limit).report(
        "limits-crossed", "limit lower " + text_of(*lower) + " is above upper " + text_of(*upper),
        *lower);
  notes.lower = lower && !crossed;
  notes.upper = upper && !crossed;
  if (notes.lower && notes.upper) narrow_to_soft_limits(joint, *lower, *upper, place, copy);
}

void check_axis(const XMLElement& joint, const XmlPlace& place, XMLElement& to) {
  const auto* axis = place.only_child(joint, "axis", Presence::optional);
  if (axis == nullptr) return;
  place.only_attributes(*axis, {"xyz"});
  XMLElement& copy = *to.InsertNewChildElement("axis");
  const auto xyz = copy_numbers(*axis, {"xyz", 3, Presence::required}, place, copy);
  const double norm = xyz ? norm_of(*xyz) : 0.0;
  if (norm >= 1e-6 && std::isfinite(norm)) {
    if (std::abs(norm - 1.0) > kUnitAxis)
      place.at(*axis).warn("axis-not-unit",
                           std::string("axis xyz '") + axis->Attribute("xyz") +
                               "' is not of length 1: only its direction is used; values of the "
                               "joint are still radians or meters",
                           norm);
    return;
  }
  to.DeleteChild(&copy);
  const char* text = axis->Attribute("xyz");
  if (xyz)
    place.at(*axis).report("zero-axis", std::string("axis xyz '") + text + "' has no direction",
                           norm);
}

// Returns the joint type for the mended robot. A floating or planar joint is fixed at its origin,
// as MoveIt does by default.
std::string check_type(const XMLElement& joint, const XmlPlace& place, UrdfNotes::Joint& notes) {
  std::string type = place.name(joint, "type");
  if (type == "fixed" || type == "revolute" || type == "prismatic" || type == "continuous")
    return type;
  if (type == "floating" || type == "planar") {
    notes.many_values = true;
    place.warn("unsupported-joint",
               "joint type " + type +
                   " is not supported: the joint is fixed at its origin, and the links below it "
                   "are checked there",
               type);
    return "fixed";
  }
  if (!type.empty())
    place.report(
        "unknown-joint-type",
        "joint type '" + type +
            "' is not known (known: revolute, continuous, prismatic, fixed, floating, planar)",
        type);
  // Guess the type from the limits, so that other faults are still found.
  const auto* limit = joint.FirstChildElement("limit");
  if (limit == nullptr) return "continuous";
  return limit->Attribute("lower") || limit->Attribute("upper") ? "revolute" : "continuous";
}

void check_joint(const XMLElement& joint, const XmlPlace& place, UrdfNotes::Joint& notes,
                 XMLElement& to) {
  place.only_children(joint, {"origin", "parent", "child", "axis", "limit", "mimic"},
                      {"dynamics", "calibration", "safety_controller", "joint_properties", "gazebo",
                       "collision", "geometry"});
  for (const char* shape : {"collision", "geometry"})
    place.refuse_child(joint, shape, "in a <link>");
  const std::string type = check_type(joint, place, notes);
  to.SetAttribute("type", type.c_str());
  for (const char* end : {"parent", "child"}) {
    const auto* element = place.only_child(joint, end, Presence::required);
    const std::string link = element == nullptr ? std::string() : place.name(*element, "link");
    to.InsertNewChildElement(end)->SetAttribute("link", link.c_str());
  }
  copy_origin(joint, place, to);
  const auto* mimic = place.only_child(joint, "mimic", Presence::optional);
  if (type == "fixed") {
    const XmlPlace unused = place.only_warning("the joint is fixed, so it plays no part");
    check_axis(joint, unused, to);
    if (mimic != nullptr)
      unused.at(*mimic).report("fixed-mimic", "a fixed joint cannot mimic another");
    return;
  }
  check_axis(joint, place, to);
  check_limit(joint, type, place, notes, to);
  if (mimic == nullptr) return;
  place.only_attributes(*mimic, {"joint", "multiplier", "offset"});
  XMLElement& copy = *to.InsertNewChildElement("mimic");
  copy.SetAttribute("joint", place.name(*mimic, "joint").c_str());
  copy_if_there(*mimic, "multiplier", 1, place, copy);
  copy_if_there(*mimic, "offset", 1, place, copy);
}

XmlPlace place_of(const XMLElement& element, const std::string& file, Diagnostics& diagnostics) {
  const char* name = element.Attribute("name");
  const std::string named = name == nullptr || *name == '\0' ? "" : std::string(" ") + name;
  return {file, element.GetLineNum(), element.Name() + named, diagnostics};
}

// Reports links and joints in elements other than <robot>, because urdfdom would ignore them.
void refuse_what_holds_links(const XMLElement& robot, const std::string& file,
                             Diagnostics& diagnostics) {
  const auto has_part = [](const XMLElement& element) {
    const auto* link = element.FirstChildElement("link");
    const auto* joint = element.FirstChildElement("joint");
    return (link != nullptr && link->FirstChildElement() != nullptr) ||
           (joint != nullptr && joint->FirstChildElement("child") != nullptr) ||
           std::string_view(element.Name()) == "collision" ||
           element.FirstChildElement("collision") != nullptr;
  };
  for (const auto* child = robot.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string tag = child->Name();
    if (tag == "link" || tag == "joint" || tag == "gazebo") continue;
    if (tag.find(':') != std::string::npos || !has_part(*child)) continue;
    XmlPlace(file, child->GetLineNum(), "robot", diagnostics)
        .report("misplaced",
                "<" + tag +
                    "> holds a part of the robot, which would be left out: <link> and <joint> "
                    "must be directly below <robot>, and <collision> in a <link>",
                tag);
  }
}

}  // namespace

UrdfNotes check_urdf_elements(const XMLElement& robot, const std::string& file,
                              const MeshFolders& folders, XMLElement& mended,
                              Diagnostics& diagnostics) {
  XmlPlace(file, robot.GetLineNum(), "robot", diagnostics)
      .only_children(robot, {"link", "joint"},
                     {"material", "transmission", "gazebo", "ros2_control", "sensor", "mujoco",
                      "plugin", "loop_joint", "verbose"});
  refuse_what_holds_links(robot, file, diagnostics);
  UrdfNotes notes;
  std::set<std::pair<std::string, std::string>> known;
  for (const auto* child = robot.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string tag = child->Name();
    if (tag != "link" && tag != "joint") continue;
    const XmlPlace place = place_of(*child, file, diagnostics);
    const std::string name = place.name(*child, "name");
    notes.lines[tag].emplace(name, child->GetLineNum());
    XMLElement& copy = *mended.InsertNewChildElement(child->Name());
    copy.SetAttribute("name", name.c_str());
    UrdfNotes::Joint joint;
    if (tag == "link")
      check_link(*child, place, folders, notes, copy);
    else
      check_joint(*child, place, joint, copy);
    const bool doubled = !name.empty() && !known.emplace(tag, name).second;
    if (doubled) place.report("duplicate-name", "more than one " + tag + " has this name", name);
    if (name.empty()) notes.nameless = true;
    if (doubled || name.empty()) {
      notes.patched = true;
      if (tag == "joint") notes.loose.insert(copy.FirstChildElement("child")->Attribute("link"));
      mended.DeleteChild(&copy);
    } else if (tag == "joint") {
      notes.joints.emplace(name, std::move(joint));
    }
  }
  return notes;
}

}  // namespace armloom
