#include "core/model/urdf_elements.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/model/mesh_path.h"
#include "core/model/xml_element.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

constexpr double kFar_m = 10.0;  // robots end before; millimetres read as metres do not

void warn_if_far(double length_m, const std::string& what, const XmlPlace& place) {
  if (length_m <= kFar_m) return;
  place.warn("far-away",
             what + " is " + text_of(length_m) +
                 " m, hardly meant (millimetres?); what hangs there is checked that far away",
             length_m);
}

// Fixed-axis roll, pitch, yaw. Formula of urdfdom's Rotation::setFromRPY.
Eigen::Quaterniond rotation_of(double roll, double pitch, double yaw) {
  const double sx = std::sin(roll / 2.0), cx = std::cos(roll / 2.0);
  const double sy = std::sin(pitch / 2.0), cy = std::cos(pitch / 2.0);
  const double sz = std::sin(yaw / 2.0), cz = std::cos(yaw / 2.0);
  return Eigen::Quaterniond(cx * cy * cz + sx * sy * sz, sx * cy * cz - cx * sy * sz,
                            cx * sy * cz + sx * cy * sz, cx * cy * sz - sx * sy * cz)
      .normalized();
}

// The pose of <origin>, identity where there is none; nothing when it is faulty.
std::optional<Eigen::Isometry3d> read_origin(const XMLElement& parent, const XmlPlace& place) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const auto* origin = place.only_child(parent, "origin", Presence::optional);
  if (origin == nullptr) return X;
  const auto xyz = place.numbers(*origin, "xyz", 3, Presence::optional);
  const auto rpy = place.numbers(*origin, "rpy", 3, Presence::optional);
  if (xyz) X.translation() = Eigen::Vector3d((*xyz)[0], (*xyz)[1], (*xyz)[2]);
  if (rpy) X.linear() = rotation_of((*rpy)[0], (*rpy)[1], (*rpy)[2]).toRotationMatrix();
  const bool faulty = (!xyz && origin->Attribute("xyz") != nullptr) ||
                      (!rpy && origin->Attribute("rpy") != nullptr);
  if (faulty) return std::nullopt;
  warn_if_far(X.translation().norm(), "origin xyz", place);
  return X;
}

std::optional<std::vector<double>> read_lengths(const XMLElement& shape, const char* attribute,
                                                std::size_t size, const XmlPlace& place) {
  auto read = place.numbers(shape, attribute, size, Presence::required);
  if (!read) return std::nullopt;
  const std::string what = std::string(shape.Name()) + " " + attribute;
  for (const double number : *read) {
    if (number > 0.0) {
      warn_if_far(number, what, place);
      continue;
    }
    place.report("not-positive", what + " is " + text_of(number) + " m, it must be greater than 0",
                 number);
    return std::nullopt;
  }
  return read;
}

std::optional<Shape> read_mesh(const XMLElement& mesh, const MeshFolders& folders,
                               const XmlPlace& place) {
  const std::string name = place.name(mesh, "filename");
  const auto scale = place.numbers(mesh, "scale", 3, Presence::optional);
  bool faulty = !scale && mesh.Attribute("scale") != nullptr;
  if (scale && std::find(scale->begin(), scale->end(), 0.0) != scale->end()) {
    place.report("not-positive", "mesh scale holds a 0", 0.0);
    faulty = true;
  }
  if (name.empty()) return std::nullopt;
  const auto path = resolve_mesh(name, folders.urdf_folder, *folders.packages);
  if (!path) place.report("mesh-unresolved", "mesh " + name + " " + path.error(), name);
  if (faulty || !path) return std::nullopt;
  return Mesh{path->string(),
              scale ? Eigen::Vector3d((*scale)[0], (*scale)[1], (*scale)[2]) : Mesh{}.scale};
}

std::optional<Shape> read_shape(const XMLElement& shape, const MeshFolders& folders,
                                const XmlPlace& place) {
  const std::string_view kind = shape.Name();
  if (kind == "mesh") return read_mesh(shape, folders, place);
  if (kind == "box") {
    const auto size = read_lengths(shape, "size", 3, place);
    if (!size) return std::nullopt;
    return Box{Eigen::Vector3d((*size)[0], (*size)[1], (*size)[2])};
  }
  if (kind == "sphere") {
    const auto radius = read_lengths(shape, "radius", 1, place);
    if (!radius) return std::nullopt;
    return Sphere{radius->front()};
  }
  if (kind == "cylinder") {
    const auto radius = read_lengths(shape, "radius", 1, place);
    const auto length = read_lengths(shape, "length", 1, place);
    if (!radius || !length) return std::nullopt;
    return Cylinder{radius->front(), length->front()};
  }
  place.report("unsupported-shape",
               "collision geometry <" + std::string(kind) +
                   "> is not supported (box, cylinder, sphere, mesh are)",
               std::string(kind), ProblemKind::unsupported);
  return std::nullopt;
}

void read_collision(const XMLElement& collision, const MeshFolders& folders, const XmlPlace& place,
                    std::vector<PlacedShape>& shapes) {
  const auto X_LS = read_origin(collision, place);
  const auto* geometry = place.only_child(collision, "geometry", Presence::required);
  if (geometry == nullptr) return;
  const auto* element = geometry->FirstChildElement();
  if (element == nullptr) return place.report("missing", "collision geometry is empty");
  if (element->NextSiblingElement() != nullptr) {
    place.report("duplicate", "collision geometry holds more than one shape");
  }
  auto shape = read_shape(*element, folders, place);
  if (shape && X_LS) shapes.push_back({*std::move(shape), *X_LS});
}

// Visuals and masses play no part in the model; their numbers still reach the dashboard.
void check_visual(const XMLElement& visual, const XmlPlace& place) {
  static_cast<void>(read_origin(visual, place));
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
  static_cast<void>(read_origin(*inertial, place));
  if (const auto* mass = place.only_child(*inertial, "mass", Presence::optional)) {
    place.number(*mass, "value", Presence::required);
  }
  if (const auto* inertia = place.only_child(*inertial, "inertia", Presence::optional)) {
    for (const char* entry : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
      place.number(*inertia, entry, Presence::optional);
    }
  }
}

UrdfLink read_link(const XMLElement& element, const MeshFolders& folders, const XmlPlace& place) {
  UrdfLink link{.name = {}, .line = element.GetLineNum(), .shapes = {}};
  if (const char* name = element.Attribute("name")) link.name = name;
  place.only_children(element, {"inertial", "visual", "collision", "contact", "sensor", "gazebo",
                                "material", "self_collision_checking", "verbose"});
  check_inertial(element, place.only_warning("masses play no part in the checks"));
  const XmlPlace seen = place.only_warning("it is seen in the dashboard, and not checked");
  for (const auto* visual = element.FirstChildElement("visual"); visual != nullptr;
       visual = visual->NextSiblingElement("visual")) {
    check_visual(*visual, seen);
  }
  for (const auto* collision = element.FirstChildElement("collision"); collision != nullptr;
       collision = collision->NextSiblingElement("collision")) {
    read_collision(*collision, folders, place, link.shapes);
  }
  return link;
}

UrdfLimits read_limits(const XMLElement& joint, std::string_view type, const XmlPlace& place) {
  UrdfLimits limits;
  const XmlPlace faults(place.text(), limits.faults);
  const auto* limit = faults.only_child(joint, "limit", Presence::optional);
  if (limit == nullptr) return limits;
  place.only_warning("efforts play no part in the checks")
      .number(*limit, "effort", Presence::optional);
  const auto velocity = faults.number(*limit, "velocity", Presence::optional);
  if (velocity && *velocity > 0.0) limits.velocity = velocity;
  if (velocity && *velocity < 0.0) {
    faults.report("not-positive",
                  "limit velocity is " + text_of(*velocity) + ", it must be greater than 0",
                  *velocity);
  }
  if (type == "continuous") return limits;  // MoveIt's too ignore what stands there
  limits.lower = faults.number(*limit, "lower", Presence::optional);
  limits.upper = faults.number(*limit, "upper", Presence::optional);
  if (limits.lower && limits.upper && *limits.lower > *limits.upper) {
    faults.report(
        "limits-crossed",
        "limit lower " + text_of(*limits.lower) + " is above upper " + text_of(*limits.upper),
        *limits.lower);
    limits.lower = limits.upper = std::nullopt;
  }
  return limits;
}

Eigen::Vector3d read_axis(const XMLElement& joint, const XmlPlace& place) {
  const Eigen::Vector3d without = Eigen::Vector3d::UnitX();
  const auto* axis = place.only_child(joint, "axis", Presence::optional);
  if (axis == nullptr) return without;
  const auto read = place.numbers(*axis, "xyz", 3, Presence::required);
  if (!read) return without;
  const double norm = std::hypot((*read)[0], (*read)[1], (*read)[2]);
  if (norm < 1e-6 || !std::isfinite(norm)) {
    place.report("zero-axis",
                 std::string("axis xyz '") + axis->Attribute("xyz") + "' has no direction", norm);
    return without;
  }
  return Eigen::Vector3d((*read)[0], (*read)[1], (*read)[2]).normalized();
}

std::string read_end(const XMLElement& joint, const char* end, const XmlPlace& place) {
  const auto* element = place.only_child(joint, end, Presence::required);
  return element == nullptr ? std::string() : place.name(*element, "link");
}

// The kind of motion; a joint of several values stands at its origin, as MoveIt has it by default.
void read_type(const XMLElement& element, const XmlPlace& place, UrdfJoint& joint) {
  const std::string type = place.name(element, "type");
  if (type == "revolute") {
    joint.motion = JointKind::revolute;
  } else if (type == "prismatic") {
    joint.motion = JointKind::prismatic;
  } else if (type == "floating" || type == "planar") {
    joint.many_values = true;
    place.warn("unsupported-joint",
               "joint type " + type + " is not moved here: what hangs on it stands at its origin",
               type);
  } else if (type != "fixed") {
    // An unknown type: as what its limits would fit, so that all else of it is told.
    const auto* limit = element.FirstChildElement("limit");
    const bool bounded =
        type != "continuous" && limit != nullptr &&
        (limit->Attribute("lower") != nullptr || limit->Attribute("upper") != nullptr);
    joint.motion = bounded ? JointKind::revolute : JointKind::continuous;
    if (type != "continuous" && !type.empty())
      place.report("unknown-joint-type", "joint type '" + type + "' is not known", type);
  }
}

UrdfJoint read_joint(const XMLElement& element, const XmlPlace& place) {
  UrdfJoint joint;
  joint.line = element.GetLineNum();
  if (const char* name = element.Attribute("name")) joint.name = name;
  place.only_children(element, {"origin", "parent", "child", "axis", "limit", "mimic", "dynamics",
                                "calibration", "safety_controller", "joint_properties", "gazebo"});
  read_type(element, place, joint);
  joint.parent = read_end(element, "parent", place);
  joint.child = read_end(element, "child", place);
  joint.X_PJ = read_origin(element, place).value_or(joint.X_PJ);
  const auto* mimic = place.only_child(element, "mimic", Presence::optional);
  if (!joint.motion) {
    const XmlPlace unused = place.only_warning("the joint is fixed, so it plays no part");
    static_cast<void>(read_axis(element, unused));
    if (mimic != nullptr) unused.report("fixed-mimic", "a fixed joint cannot mimic another");
    return joint;
  }
  joint.axis = read_axis(element, place);
  joint.limits =
      read_limits(element, *joint.motion == JointKind::continuous ? "continuous" : "", place);
  if (mimic != nullptr) {
    joint.mimic = UrdfMimic{place.name(*mimic, "joint"),
                            place.number(*mimic, "multiplier", Presence::optional).value_or(1.0),
                            place.number(*mimic, "offset", Presence::optional).value_or(0.0)};
  }
  return joint;
}

std::string place_of(const XMLElement& element, const std::string& file) {
  const char* name = element.Attribute("name");
  const std::string known = name != nullptr && *name != '\0'
                                ? std::string(" ") + name
                                : " at line " + std::to_string(element.GetLineNum());
  return file + ": " + element.Name() + known;
}

}  // namespace

UrdfElements read_urdf_elements(const XMLElement& robot, const std::string& file,
                                const MeshFolders& folders, Findings& findings) {
  UrdfElements elements;
  for (const auto* child = robot.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string_view tag = child->Name();
    const XmlPlace place(place_of(*child, file), findings);
    if (tag == "link") {
      elements.links.push_back(read_link(*child, folders, place));
    } else if (tag == "joint") {
      elements.joints.push_back(read_joint(*child, place));
    }
  }
  return elements;
}

}  // namespace armloom
