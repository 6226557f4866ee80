#include "server/codec/scene_format.h"

#include <array>
#include <optional>

#include "server/codec/pose_words.h"
#include "server/codec/scalar_formats.h"

namespace armloom {

using namespace formats;

namespace {

constexpr Range kLength{0.0, 1000.0, true};                           // m
constexpr Range kPosition{-1000.0, 1000.0};                           // m
constexpr Range kAngle{-6.3, 6.3, false, "; degrees go to rpy_deg"};  // rad: a full turn
constexpr Range kAngleDegrees{-3600.0, 3600.0};

struct ShapeWords {
  std::optional<Eigen::Vector3d> box;
  std::optional<std::array<double, 2>> cylinder;
  std::optional<std::array<double, 1>> sphere;
  std::optional<std::string> mesh;
  std::optional<Eigen::Vector3d> scale;
};

struct InWords {
  ShapeWords operator()(const Box& box) const { return {.box = box.size_m}; }
  ShapeWords operator()(const Cylinder& cylinder) const {
    return {.cylinder = std::array{cylinder.radius_m, cylinder.length_m}};
  }
  ShapeWords operator()(const Sphere& sphere) const {
    return {.sphere = std::array{sphere.radius_m}};
  }
  ShapeWords operator()(const Mesh& mesh) const { return {.mesh = mesh.path, .scale = mesh.scale}; }
};

ShapeWords shape_in_words(const Shape& shape) { return std::visit(InWords{}, shape); }

Shape shape_of_words(const ShapeWords& words) {
  if (words.cylinder) return Cylinder{(*words.cylinder)[0], (*words.cylinder)[1]};
  if (words.sphere) return Sphere{(*words.sphere)[0]};
  if (words.mesh) return Mesh{*words.mesh, words.scale.value_or(Eigen::Vector3d::Ones())};
  return Box{words.box.value_or(Eigen::Vector3d::Zero())};
}

PartList<ShapeWords> primitives() {
  return {
      field("box", &ShapeWords::box, vector3(kLength), "A box: full side lengths, in meters."),
      field("cylinder", &ShapeWords::cylinder, numbers<2>(kLength),
            "A cylinder along z: radius and full length, in meters."),
      field("sphere", &ShapeWords::sphere, numbers<1>(kLength), "A sphere: radius, in meters."),
  };
}

struct MassWords {
  std::optional<double> kg;
  std::optional<Eigen::Vector3d> center;
};

MassWords mass_in_words(const Mass& mass) {
  return mass == Mass{} ? MassWords{} : MassWords{mass.kg, mass.center};
}

Mass mass_of_words(const MassWords& words) {
  return {words.kg.value_or(0.0), words.center.value_or(Eigen::Vector3d::Zero())};
}

PartPtr<Shape> shape_part() {
  PartList<ShapeWords> parts = primitives();
  parts.add({field("mesh", &ShapeWords::mesh, path(),
                   "A mesh: path of an STL, OBJ or DAE file. Everything that the mesh encloses is "
                   "treated as solid, cavities included."),
             only_with("mesh", &ShapeWords::mesh,
                       field("scale", &ShapeWords::scale, vector3(kAnyNumber),
                             "Scale factors of a mesh along x, y and z.", Schema{1, 1, 1})),
             exactly_one<ShapeWords>({"box", "cylinder", "sphere", "mesh"})});
  return spelt(parts, shape_in_words, shape_of_words);
}

}  // namespace

PartPtr<Shape> primitive_part() {
  PartList<ShapeWords> parts = primitives();
  parts.add({exactly_one<ShapeWords>({"box", "cylinder", "sphere"})});
  return spelt(parts, shape_in_words, shape_of_words);
}

PartPtr<Eigen::Isometry3d> pose_part(Need xyz) {
  return spelt(
      PartList<PoseWords>{
          member({"xyz", "Position, in meters.", xyz, std::nullopt}, &PoseWords::xyz_m,
                 vector3(kPosition)),
          field("rpy", &PoseWords::rpy_rad, vector3(kAngle),
                "Roll, pitch, yaw about fixed axes, in radians, as in a URDF."),
          read_only(field("rpy_deg", &PoseWords::rpy_deg, vector3(kAngleDegrees),
                          "Roll, pitch, yaw in degrees, instead of rpy.")),
          read_only(at_most_one<PoseWords>({"rpy", "rpy_deg"})),
      },
      pose_in_words, pose_of_words);
}

PartPtr<Mass> mass_part() {
  PartList<MassWords> parts = {
      field("mass_kg", &MassWords::kg, number(Mass::range),
            "Mass, in kilograms. An arm that holds the object moves slower (`payload` of the arm). "
            "Default: light enough not to matter."),
      only_with("mass_kg", &MassWords::kg,
                field("center_of_mass_m", &MassWords::center, vector3(kPosition),
                      "Center of mass in the object's frame, in meters.", Schema{0, 0, 0})),
  };
  return spelt(parts, mass_in_words, mass_of_words);
}

FormatPtr<ObjectDescription> scene_object_format() {
  static const FormatPtr<ObjectDescription> format = object<ObjectDescription>({
      required("name", &ObjectDescription::name, name(),
               "Name of the object; unique in the cell, and not the name of a link or robot."),
      inlined(&ObjectDescription::shape, shape_part()),
      inlined(&ObjectDescription::X_WO, pose_part()),
      inlined(&ObjectDescription::mass, mass_part()),
  });
  return format;
}

}  // namespace armloom
