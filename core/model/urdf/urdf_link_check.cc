#include <tinyxml2.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "core/model/urdf/mesh_path.h"
#include "core/model/urdf/urdf_check.h"
#include "core/model/urdf/urdf_copy.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

bool copy_lengths(const XMLElement& shape, const char* attribute, std::size_t size,
                  const XmlPlace& place, XMLElement& to) {
  const auto read = copy_numbers(shape, {attribute, size, Presence::required}, place, to);
  if (!read) return false;
  const std::string what = std::string(shape.Name()) + " " + attribute;
  for (const double number : *read) {
    warn_if_far(number, what, place.at(shape));
    if (number > 0.0) continue;
    place.at(shape).report(
        "not-positive", what + " is " + text_of(number) + " m, it must be greater than 0", number);
    return false;
  }
  return true;
}

// Copies a mesh without changing its name. Stores the path of its file in the notes.
bool copy_mesh(const XMLElement& mesh, const XmlPlace& place, const MeshFolders& folders,
               UrdfNotes& notes, XMLElement& to) {
  place.only_attributes(mesh, {"filename", "scale"});
  const std::string name = place.name(mesh, "filename");
  to.SetAttribute("filename", name.c_str());
  const auto scale = copy_numbers(mesh, {"scale", 3, Presence::optional}, place, to);
  const bool flat = scale && std::find(scale->begin(), scale->end(), 0.0) != scale->end();
  if (flat) place.at(mesh).report("not-positive", "mesh scale holds a 0", 0.0);
  if (name.empty()) return false;
  const auto path = resolve_mesh(name, folders.urdf_folder, *folders.packages);
  if (path)
    notes.meshes.emplace(name, path->string());
  else
    place.at(mesh).report("mesh-unresolved", "mesh " + name + " " + path.error(), name);
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
  place.at(shape).report("unsupported-shape",
                         "collision geometry <" + std::string(kind) +
                             "> is not supported (supported: box, cylinder, sphere, mesh; for a "
                             "capsule, use a cylinder and two spheres)",
                         std::string(kind), ProblemKind::unsupported);
  return false;
}

bool copy_collision(const XMLElement& collision, const XmlPlace& place, const MeshFolders& folders,
                    UrdfNotes& notes, XMLElement& to) {
  place.only_children(collision, {"origin", "geometry"},
                      {"contact", "contact_coefficients", "material", "surface", "gazebo",
                       "verbose", "max_contacts"});
  const bool placed = copy_origin(collision, place, to);
  const auto* geometry = place.only_child(collision, "geometry", Presence::required);
  if (geometry == nullptr) return false;
  const auto* shape = geometry->FirstChildElement();
  if (shape == nullptr) {
    place.at(*geometry).report("missing", "collision geometry is empty");
    return false;
  }
  if (shape->NextSiblingElement() != nullptr)
    place.at(*shape->NextSiblingElement())
        .report("duplicate", "collision geometry holds more than one shape");
  XMLElement& copy = *to.InsertNewChildElement("geometry");
  return copy_shape(*shape, place, folders, notes, copy) && placed;
}

// Checks a <visual>, whose numbers only the dashboard uses.
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

}  // namespace

void check_link(const XMLElement& link, const XmlPlace& place, const MeshFolders& folders,
                UrdfNotes& notes, XMLElement& to) {
  place.only_children(link, {"collision"},
                      {"inertial", "visual", "contact", "sensor", "gazebo", "material",
                       "self_collision_checking", "verbose", "geometry"});
  place.refuse_child(link, "geometry", "in a <collision>");
  XMLElement& unused = *to.GetDocument()->NewElement("unused");
  check_inertial(link, place.only_warning("masses play no part in the checks"), unused);
  const XmlPlace seen = place.only_warning("it is only displayed, not checked");
  for (const auto* child = link.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string_view tag = child->Name();
    if (tag == "visual") {
      check_visual(*child, seen, unused);
      if (const char* name = link.Attribute("name")) notes.seen.insert(name);
    }
    if (tag != "collision") continue;
    if (const char* name = link.Attribute("name")) notes.solid.insert(name);
    XMLElement& copy = *to.InsertNewChildElement("collision");
    if (!copy_collision(*child, place, folders, notes, copy)) to.DeleteChild(&copy);
  }
}

}  // namespace armloom
