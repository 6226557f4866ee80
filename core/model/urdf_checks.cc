#include "core/model/urdf_checks.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/model/xml_element.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

void check_origin(const XMLElement& parent, const XmlPlace& place) {
  if (const auto* origin = place.only_child(parent, "origin", Presence::optional)) {
    place.numbers(*origin, "xyz", 3, Presence::optional);
    place.numbers(*origin, "rpy", 3, Presence::optional);
  }
}

void check_positive(const XMLElement& shape, const char* attribute, std::size_t size,
                    const XmlPlace& place) {
  const auto read = place.numbers(shape, attribute, size, Presence::required);
  if (!read) return;
  for (const double number : *read) {
    if (number > 0.0) continue;
    place.report("not-positive",
                 std::string(shape.Name()) + " " + attribute + " is " + text_of(number) +
                     " m, it must be greater than 0",
                 number);
  }
}

void check_mesh(const XMLElement& mesh, const XmlPlace& place) {
  place.name(mesh, "filename");
  if (const auto scale = place.numbers(mesh, "scale", 3, Presence::optional)) {
    if (std::find(scale->begin(), scale->end(), 0.0) != scale->end()) {
      place.report("not-positive", "mesh scale holds a 0", 0.0);
    }
  }
}

void check_collision(const XMLElement& collision, const XmlPlace& place) {
  check_origin(collision, place);
  const auto* geometry = place.only_child(collision, "geometry", Presence::required);
  if (geometry == nullptr) return;
  const auto* shape = geometry->FirstChildElement();
  if (shape == nullptr) return place.report("missing", "collision geometry is empty");
  if (shape->NextSiblingElement() != nullptr) {
    place.report("duplicate", "collision geometry holds more than one shape");
  }
  const std::string_view kind = shape->Name();
  if (kind == "box") return check_positive(*shape, "size", 3, place);
  if (kind == "sphere") return check_positive(*shape, "radius", 1, place);
  if (kind == "mesh") return check_mesh(*shape, place);
  if (kind == "cylinder") {
    check_positive(*shape, "radius", 1, place);
    return check_positive(*shape, "length", 1, place);
  }
  place.report("unsupported-shape",
               "collision geometry <" + std::string(kind) +
                   "> is not supported (box, cylinder, sphere, mesh are)",
               std::string(kind), ProblemKind::unsupported);
}

// Visuals and masses play no part in the model; their numbers still reach the dashboard.
void check_numbers_of_visual(const XMLElement& visual, const XmlPlace& place) {
  check_origin(visual, place);
  const auto* geometry = visual.FirstChildElement("geometry");
  const auto* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  if (shape == nullptr) return;
  place.numbers(*shape, "size", 3, Presence::optional);
  place.numbers(*shape, "radius", 1, Presence::optional);
  place.numbers(*shape, "length", 1, Presence::optional);
  place.numbers(*shape, "scale", 3, Presence::optional);
}

void check_inertial(const XMLElement& link, const XmlPlace& place) {
  const auto* inertial = place.only_child(link, "inertial", Presence::optional);
  if (inertial == nullptr) return;
  check_origin(*inertial, place);
  if (const auto* mass = place.only_child(*inertial, "mass", Presence::optional)) {
    place.number(*mass, "value", Presence::required);
  }
  if (const auto* inertia = place.only_child(*inertial, "inertia", Presence::optional)) {
    for (const char* entry : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
      place.number(*inertia, entry, Presence::optional);
    }
  }
}

void check_link(const XMLElement& link, const XmlPlace& place) {
  place.only_children(link, {"inertial", "visual", "collision", "contact", "sensor", "gazebo",
                             "material", "self_collision_checking", "verbose"});
  check_inertial(link, place);
  for (const auto* visual = link.FirstChildElement("visual"); visual != nullptr;
       visual = visual->NextSiblingElement("visual")) {
    check_numbers_of_visual(*visual, place);
  }
  for (const auto* collision = link.FirstChildElement("collision"); collision != nullptr;
       collision = collision->NextSiblingElement("collision")) {
    check_collision(*collision, place);
  }
}

void check_limit(const XMLElement& joint, std::string_view type, const XmlPlace& place) {
  const bool movable = type != "fixed";
  const bool bounded = type == "revolute" || type == "prismatic";
  const auto* limit =
      place.only_child(joint, "limit", movable ? Presence::required : Presence::optional);
  if (limit == nullptr) return;
  const auto presence = movable ? Presence::required : Presence::optional;
  place.number(*limit, "effort", presence);
  const auto velocity = place.number(*limit, "velocity", presence);
  if (movable && velocity && *velocity <= 0.0) {
    place.report("not-positive",
                 "limit velocity is " + text_of(*velocity) + ", it must be greater than 0",
                 *velocity);
  }
  // The URDF specification lets lower and upper be absent and takes 0: a joint that cannot move.
  const auto lower =
      place.number(*limit, "lower", bounded ? Presence::required : Presence::optional);
  const auto upper =
      place.number(*limit, "upper", bounded ? Presence::required : Presence::optional);
  if (bounded && lower && upper && *lower > *upper) {
    place.report("limits-crossed",
                 "limit lower " + text_of(*lower) + " is above upper " + text_of(*upper), *lower);
  }
}

void check_axis(const XMLElement& joint, const XmlPlace& place) {
  const auto* axis = place.only_child(joint, "axis", Presence::optional);
  if (axis == nullptr) return;
  const auto read = place.numbers(*axis, "xyz", 3, Presence::required);
  if (!read) return;
  const double norm = std::hypot((*read)[0], (*read)[1], (*read)[2]);
  const std::string_view type = joint.Attribute("type");
  if (type != "fixed" && (norm < 1e-6 || !std::isfinite(norm))) {
    place.report("zero-axis",
                 std::string("axis xyz '") + axis->Attribute("xyz") + "' has no direction", norm);
  }
}

void check_joint(const XMLElement& joint, const XmlPlace& place) {
  place.only_children(joint, {"origin", "parent", "child", "axis", "limit", "mimic", "dynamics",
                              "calibration", "safety_controller", "joint_properties", "gazebo"});
  const std::string type = place.name(joint, "type");
  if (type.empty()) return;
  if (type == "floating" || type == "planar") {
    return place.report("unsupported-joint", "joint type " + type + " is not supported", type,
                        ProblemKind::unsupported);
  }
  if (type != "fixed" && type != "revolute" && type != "continuous" && type != "prismatic") {
    return place.report("unknown-joint-type", "joint type '" + type + "' is not known", type);
  }
  check_origin(joint, place);
  check_axis(joint, place);
  check_limit(joint, type, place);
  if (const auto* mimic = place.only_child(joint, "mimic", Presence::optional)) {
    place.number(*mimic, "multiplier", Presence::optional);
    place.number(*mimic, "offset", Presence::optional);
    if (type == "fixed") place.report("fixed-mimic", "a fixed joint cannot mimic another");
  }
}

std::string place_of(const XMLElement& element, const std::string& file) {
  const char* name = element.Attribute("name");
  const std::string known = name != nullptr && *name != '\0'
                                ? std::string(" ") + name
                                : " at line " + std::to_string(element.GetLineNum());
  return file + ": " + element.Name() + known;
}

}  // namespace

void check_urdf_elements(const XMLElement& robot, const std::string& file, Findings& findings) {
  XmlPlace(file + ": robot", findings).name(robot, "name");
  std::size_t links = 0;
  for (const auto* child = robot.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string_view tag = child->Name();
    const XmlPlace place(place_of(*child, file), findings);
    if (tag == "link") {
      ++links;
      check_link(*child, place);
    } else if (tag == "joint") {
      check_joint(*child, place);
    }
  }
  if (links > kMaxLinksOfRobot) {
    XmlPlace(file + ": robot", findings)
        .report("too-many-links",
                std::to_string(links) + " links, at most " + std::to_string(kMaxLinksOfRobot) +
                    " are allowed",
                static_cast<double>(links), ProblemKind::too_large);
  }
}

}  // namespace armloom
