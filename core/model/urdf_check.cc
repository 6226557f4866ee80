#include "core/model/urdf_check.h"

#include <tinyxml2.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

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

// Copies an attribute of numbers, written anew: urdfdom knows no white space but blanks.
std::optional<std::vector<double>> copy_numbers(const XMLElement& from, const char* attribute,
                                                std::size_t size, Presence presence,
                                                const XmlPlace& place, XMLElement& to) {
  auto numbers = place.numbers(from, attribute, size, presence);
  if (!numbers) return std::nullopt;
  std::string text;
  for (const double number : *numbers) text += (text.empty() ? "" : " ") + text_of(number);
  to.SetAttribute(attribute, text.c_str());
  return numbers;
}

// Whether the attribute is right, or absent.
bool copy_if_there(const XMLElement& from, const char* attribute, std::size_t size,
                   const XmlPlace& place, XMLElement& to) {
  return from.Attribute(attribute) == nullptr ||
         copy_numbers(from, attribute, size, Presence::optional, place, to);
}

double norm_of(const std::vector<double>& v) { return Eigen::Vector3d(v[0], v[1], v[2]).norm(); }

bool copy_origin(const XMLElement& parent, const XmlPlace& place, XMLElement& to) {
  const auto* origin = place.only_child(parent, "origin", Presence::optional);
  if (origin == nullptr) return true;
  XMLElement& copy = *to.InsertNewChildElement("origin");
  const auto xyz = copy_numbers(*origin, "xyz", 3, Presence::optional, place, copy);
  const bool rpy_right = copy_if_there(*origin, "rpy", 3, place, copy);
  if (!rpy_right || (!xyz && origin->Attribute("xyz") != nullptr)) return false;
  if (xyz) warn_if_far(norm_of(*xyz), "origin xyz", place);
  return true;
}

bool copy_lengths(const XMLElement& shape, const char* attribute, std::size_t size,
                  const XmlPlace& place, XMLElement& to) {
  const auto read = copy_numbers(shape, attribute, size, Presence::required, place, to);
  if (!read) return false;
  const std::string what = std::string(shape.Name()) + " " + attribute;
  for (const double number : *read) {
    warn_if_far(number, what, place);
    if (number > 0.0) continue;
    place.report("not-positive", what + " is " + text_of(number) + " m, it must be greater than 0",
                 number);
    return false;
  }
  return true;
}

// The name stays as it is; where the mesh lies goes to the notes.
bool copy_mesh(const XMLElement& mesh, const XmlPlace& place, const MeshFolders& folders,
               UrdfNotes& notes, XMLElement& to) {
  const std::string name = place.name(mesh, "filename");
  to.SetAttribute("filename", name.c_str());
  const auto scale = copy_numbers(mesh, "scale", 3, Presence::optional, place, to);
  const bool flat = scale && std::find(scale->begin(), scale->end(), 0.0) != scale->end();
  if (flat) place.report("not-positive", "mesh scale holds a 0", 0.0);
  if (name.empty()) return false;
  const auto path = resolve_mesh(name, folders.urdf_folder, *folders.packages);
  if (path)
    notes.meshes.emplace(name, path->string());
  else
    place.report("mesh-unresolved", "mesh " + name + " " + path.error(), name);
  return path && !flat && (scale || mesh.Attribute("scale") == nullptr);
}

bool copy_shape(const XMLElement& shape, const XmlPlace& place, const MeshFolders& folders,
                UrdfNotes& notes, XMLElement& geometry) {
  const std::string_view kind = shape.Name();
  XMLElement& copy = *geometry.InsertNewChildElement(shape.Name());
  if (kind == "mesh") return copy_mesh(shape, place, folders, notes, copy);
  if (kind == "box") return copy_lengths(shape, "size", 3, place, copy);
  if (kind == "sphere") return copy_lengths(shape, "radius", 1, place, copy);
  if (kind == "cylinder") {
    const bool radius_right = copy_lengths(shape, "radius", 1, place, copy);
    return copy_lengths(shape, "length", 1, place, copy) && radius_right;
  }
  place.report("unsupported-shape",
               "collision geometry <" + std::string(kind) +
                   "> is not supported (box, cylinder, sphere, mesh are)",
               std::string(kind), ProblemKind::unsupported);
  return false;
}

bool copy_collision(const XMLElement& collision, const XmlPlace& place, const MeshFolders& folders,
                    UrdfNotes& notes, XMLElement& to) {
  const bool placed = copy_origin(collision, place, to);
  const auto* geometry = place.only_child(collision, "geometry", Presence::required);
  if (geometry == nullptr) return false;
  const auto* shape = geometry->FirstChildElement();
  if (shape == nullptr) {
    place.report("missing", "collision geometry is empty");
    return false;
  }
  if (shape->NextSiblingElement() != nullptr)
    place.report("duplicate", "collision geometry holds more than one shape");
  XMLElement& copy = *to.InsertNewChildElement("geometry");
  return copy_shape(*shape, place, folders, notes, copy) && placed;
}

// Visuals and masses play no part in the model; their numbers still reach the dashboard.
void check_visual(const XMLElement& visual, const XmlPlace& place, XMLElement& unused) {
  copy_origin(visual, place, unused);
  const auto* geometry = visual.FirstChildElement("geometry");
  const auto* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  if (shape == nullptr) return;
  place.numbers(*shape, "size", 3, Presence::optional);
  for (const char* length : {"radius", "length"}) place.number(*shape, length, Presence::optional);
  place.numbers(*shape, "scale", 3, Presence::optional);
}

void check_inertial(const XMLElement& link, const XmlPlace& place, XMLElement& unused) {
  const auto* inertial = place.only_child(link, "inertial", Presence::optional);
  if (inertial == nullptr) return;
  copy_origin(*inertial, place, unused);
  if (const auto* mass = place.only_child(*inertial, "mass", Presence::optional))
    place.number(*mass, "value", Presence::required);
  if (const auto* inertia = place.only_child(*inertial, "inertia", Presence::optional)) {
    for (const char* entry : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"})
      place.number(*inertia, entry, Presence::optional);
  }
}

void check_link(const XMLElement& link, const XmlPlace& place, const MeshFolders& folders,
                UrdfNotes& notes, XMLElement& to) {
  place.only_children(link, {"inertial", "visual", "collision", "contact", "sensor", "gazebo",
                             "material", "self_collision_checking", "verbose"});
  XMLElement& unused = *to.GetDocument()->NewElement("unused");
  check_inertial(link, place.only_warning("masses play no part in the checks"), unused);
  const XmlPlace seen = place.only_warning("it is seen in the dashboard, and not checked");
  for (const auto* child = link.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string_view tag = child->Name();
    if (tag == "visual") check_visual(*child, seen, unused);
    if (tag != "collision") continue;
    XMLElement& copy = *to.InsertNewChildElement("collision");
    if (!copy_collision(*child, place, folders, notes, copy)) to.DeleteChild(&copy);
  }
}

// urdfdom wants a limit, with effort and velocity; the notes say what of it the file gives.
void check_limit(const XMLElement& joint, std::string_view type, const XmlPlace& place,
                 UrdfNotes::Joint& notes, XMLElement& to) {
  XMLElement& copy = *to.InsertNewChildElement("limit");
  for (const char* form : {"effort", "velocity"}) copy.SetAttribute(form, "0");
  const XmlPlace faults(place.text(), notes.faults);
  const auto* limit = faults.only_child(joint, "limit", Presence::optional);
  if (limit == nullptr) return;
  const auto number = [&](const char* attribute) {
    const auto one = copy_numbers(*limit, attribute, 1, Presence::optional, faults, copy);
    return one ? std::optional(one->front()) : std::nullopt;
  };
  place.only_warning("efforts play no part in the checks")
      .number(*limit, "effort", Presence::optional);
  const auto velocity = number("velocity");
  notes.velocity = velocity && *velocity > 0.0;  // 0 says nothing, as for MoveIt
  if (velocity && *velocity < 0.0)
    faults.report("not-positive",
                  "limit velocity is " + text_of(*velocity) + ", it must be greater than 0",
                  *velocity);
  if (type == "continuous") return;  // MoveIt's too ignore what stands there
  const auto lower = number("lower");
  const auto upper = number("upper");
  const bool crossed = lower && upper && *lower > *upper;
  if (crossed)
    faults.report("limits-crossed",
                  "limit lower " + text_of(*lower) + " is above upper " + text_of(*upper), *lower);
  notes.lower = lower && !crossed;
  notes.upper = upper && !crossed;
}

void check_axis(const XMLElement& joint, const XmlPlace& place, XMLElement& to) {
  const auto* axis = place.only_child(joint, "axis", Presence::optional);
  if (axis == nullptr) return;
  XMLElement& copy = *to.InsertNewChildElement("axis");
  const auto xyz = copy_numbers(*axis, "xyz", 3, Presence::required, place, copy);
  const double norm = xyz ? norm_of(*xyz) : 0.0;
  if (norm >= 1e-6 && std::isfinite(norm)) return;
  to.DeleteChild(&copy);
  const char* text = axis->Attribute("xyz");
  if (xyz) place.report("zero-axis", std::string("axis xyz '") + text + "' has no direction", norm);
}

// The type for urdfdom. A joint of several values stands at its origin, as MoveIt has it by
// default.
std::string check_type(const XMLElement& joint, const XmlPlace& place, UrdfNotes::Joint& notes) {
  std::string type = place.name(joint, "type");
  if (type == "fixed" || type == "revolute" || type == "prismatic" || type == "continuous")
    return type;
  if (type == "floating" || type == "planar") {
    notes.many_values = true;
    place.warn("unsupported-joint",
               "joint type " + type + " is not moved here: what hangs on it stands at its origin",
               type);
    return "fixed";
  }
  if (!type.empty())
    place.report("unknown-joint-type", "joint type '" + type + "' is not known", type);
  // As what its limits would fit, so that all else of it is told.
  const auto* limit = joint.FirstChildElement("limit");
  if (limit == nullptr) return "continuous";
  return limit->Attribute("lower") || limit->Attribute("upper") ? "revolute" : "continuous";
}

void check_joint(const XMLElement& joint, const XmlPlace& place, UrdfNotes::Joint& notes,
                 XMLElement& to) {
  place.only_children(joint, {"origin", "parent", "child", "axis", "limit", "mimic", "dynamics",
                              "calibration", "safety_controller", "joint_properties", "gazebo"});
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
    if (mimic != nullptr) unused.report("fixed-mimic", "a fixed joint cannot mimic another");
    return;
  }
  check_axis(joint, place, to);
  check_limit(joint, type, place, notes, to);
  if (mimic == nullptr) return;
  XMLElement& copy = *to.InsertNewChildElement("mimic");
  copy.SetAttribute("joint", place.name(*mimic, "joint").c_str());
  copy_if_there(*mimic, "multiplier", 1, place, copy);
  copy_if_there(*mimic, "offset", 1, place, copy);
}

std::string place_of(const XMLElement& element, const std::string& file) {
  const char* name = element.Attribute("name");
  const std::string place = file + ": " + element.Name() + " ";
  if (name != nullptr && *name != '\0') return place + name;
  return place + "at line " + std::to_string(element.GetLineNum());
}

}  // namespace

UrdfNotes check_urdf_elements(const XMLElement& robot, const std::string& file,
                              const MeshFolders& folders, XMLElement& mended, Findings& findings) {
  UrdfNotes notes;
  std::set<std::pair<std::string, std::string>> known;
  for (const auto* child = robot.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string tag = child->Name();
    if (tag != "link" && tag != "joint") continue;
    const XmlPlace place(place_of(*child, file), findings);
    const std::string name = place.name(*child, "name");
    XMLElement& copy = *mended.InsertNewChildElement(child->Name());
    copy.SetAttribute("name", name.c_str());
    UrdfNotes::Joint joint;
    if (tag == "link")
      check_link(*child, place, folders, notes, copy);
    else
      check_joint(*child, place, joint, copy);
    const bool doubled = !name.empty() && !known.emplace(tag, name).second;
    if (doubled) place.report("duplicate-name", "more than one " + tag + " has this name", name);
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
