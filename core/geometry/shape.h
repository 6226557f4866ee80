#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <variant>

namespace armloom {

// Collision shapes, each in its own frame S; boxes, cylinders and spheres are centered there.
// Lengths are in meters. The axis of a cylinder is z, as in URDF.
struct Box {
  Eigen::Vector3d size_m;  // full side lengths

  bool operator==(const Box&) const = default;
};
struct Cylinder {
  double radius_m;
  double length_m;  // full height, flat ends

  bool operator==(const Cylinder&) const = default;
};
struct Sphere {
  double radius_m;

  bool operator==(const Sphere&) const = default;
};
struct MeshData;  // core/geometry/mesh/mesh.h
struct Mesh {
  std::string path;  // resolved file
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  // The triangles with the scale applied. Set for every mesh of a Cell; null while a cell is read.
  std::shared_ptr<const MeshData> data = nullptr;

  bool operator==(const Mesh&) const = default;  // compares `data` by address
};
using Shape = std::variant<Box, Cylinder, Sphere, Mesh>;

// A shape fixed to a link or object frame L.
struct PlacedShape {
  Shape shape;
  Eigen::Isometry3d X_LS = Eigen::Isometry3d::Identity();
};

}  // namespace armloom
