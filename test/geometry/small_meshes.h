#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/mesh/mesh.h"
#include "core/geometry/shape.h"

namespace armloom::small {

struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
};

inline Surface box_surface(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Surface box;
  for (int i = 0; i < 8; ++i) {
    box.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                              i & 4 ? high.z() : low.z());
  }
  for (const auto& [a, b, c, d] : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 6, 7, 3},
                                   {0, 4, 6, 2},
                                   {1, 3, 7, 5}}) {
    box.triangles.push_back({a, b, c});
    box.triangles.push_back({a, c, d});
  }
  return box;
}

inline Surface joined(Surface a, const Surface& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

// Returns a concave mesh, 1 m wide and high: two walls on a floor, with a slot along x.
inline Surface channel(double slot_m) {
  const double s = slot_m / 2;
  return joined(
      joined(box_surface({-0.5, -0.5, 0}, {-s, 0.5, 1}), box_surface({s, -0.5, 0}, {0.5, 0.5, 1})),
      box_surface({-0.5, -0.5, -0.1}, {0.5, 0.5, 0}));
}

inline std::string number(double value) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << value;
  return text.str();
}

inline std::string stl_text(const Surface& surface) {
  std::string text = "solid part\n";
  for (const Triangle& triangle : surface.triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const std::uint32_t i : triangle) {
      const Eigen::Vector3d& p = surface.vertices[i];
      text += "  vertex " + number(p.x()) + " " + number(p.y()) + " " + number(p.z()) + "\n";
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid part\n";
}

// `count`: the number of triangles that the header claims; 0 for the true number.
inline std::string stl_bytes(const Surface& surface, std::uint32_t count = 0) {
  std::string bytes(80, ' ');
  const auto append = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(count > 0 ? count : static_cast<std::uint32_t>(surface.triangles.size()));
  for (const Triangle& triangle : surface.triangles) {
    for (int i = 0; i < 3; ++i) append(0.0F);
    for (const std::uint32_t i : triangle) {
      for (int axis = 0; axis < 3; ++axis) append(static_cast<float>(surface.vertices[i][axis]));
    }
    append(std::uint16_t{0});
  }
  return bytes;
}

inline std::string obj_text(const Surface& surface) {
  std::string text = "mtllib /etc/hostname\n";
  for (const Eigen::Vector3d& p : surface.vertices) {
    text += "v " + number(p.x()) + " " + number(p.y()) + " " + number(p.z()) + "\n";
  }
  for (const Triangle& t : surface.triangles) {
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
            std::to_string(t[2] + 1) + "\n";
  }
  return text;
}

// `scene`: content of <visual_scene>; `nodes`: content of <library_nodes>.
inline std::string dae_text(const Surface& surface, const std::string& unit,
                            const std::string& scene, const std::string& nodes = "",
                            const std::string& up_axis = "Z_UP") {
  std::string floats;
  for (const Eigen::Vector3d& p : surface.vertices) {
    floats += number(p.x()) + " " + number(p.y()) + " " + number(p.z()) + " ";
  }
  std::string indices;
  for (const Triangle& t : surface.triangles) {
    for (const std::uint32_t i : t) indices += std::to_string(i) + " ";
  }
  const std::string points = std::to_string(surface.vertices.size());
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset>)" +
         unit + "<up_axis>" + up_axis + R"(</up_axis></asset>
 <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="pa" count=")" +
         std::to_string(3 * surface.vertices.size()) + "\">" + floats +
         R"(</float_array><technique_common><accessor source="#pa" count=")" + points +
         R"(" stride="3">
   <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
  </accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count=")" +
         std::to_string(surface.triangles.size()) +
         R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)" + indices + R"(</p></triangles>
 </mesh></geometry></library_geometries>
 <library_nodes>)" +
         nodes + R"(</library_nodes>
 <library_visual_scenes><visual_scene id="s">)" +
         scene + R"(</visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";
}

inline Mesh mesh_of(const Surface& surface) {
  auto data = std::make_shared<MeshData>();
  data->vertices = surface.vertices;
  data->triangles = surface.triangles;
  data->hull = convex_hull(surface.vertices).value();
  return Mesh{"by hand", Eigen::Vector3d::Ones(), std::move(data)};
}

}  // namespace armloom::small
