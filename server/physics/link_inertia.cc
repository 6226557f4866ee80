#include "server/physics/link_inertia.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <variant>

#include "core/geometry/mesh/mesh.h"

namespace armloom {
namespace {

bool is_inside(const ConvexHull& hull, const Eigen::Vector3d& p) {
  return std::all_of(hull.faces.begin(), hull.faces.end(), [&](const auto& face) {
    const Eigen::Vector3d& a = hull.vertices[face[0]];
    const Eigen::Vector3d normal = (hull.vertices[face[1]] - a).cross(hull.vertices[face[2]] - a);
    return normal.dot(p - a) <= 0.0;
  });
}

// Returns true if the point p (in the shape's frame) is inside.
struct Contains {
  const Eigen::Vector3d& p;

  bool operator()(const Box& box) const {
    return (p.cwiseAbs().array() <= box.size_m.array() / 2.0).all();
  }
  bool operator()(const Cylinder& cylinder) const {
    return std::abs(p.z()) <= cylinder.length_m / 2.0 && p.head<2>().norm() <= cylinder.radius_m;
  }
  bool operator()(const Sphere& sphere) const { return p.norm() <= sphere.radius_m; }
  bool operator()(const Mesh& mesh) const {
    if (mesh.data->pieces.empty()) return is_inside(mesh.data->hull, p);
    return std::any_of(mesh.data->pieces.begin(), mesh.data->pieces.end(),
                       [this](const ConvexHull& piece) { return is_inside(piece, p); });
  }
};

// Returns a box around the shape, in the shape's frame.
struct BoundingBox {
  static Eigen::AlignedBox3d around(const Eigen::Vector3d& half) { return {-half, half}; }

  Eigen::AlignedBox3d operator()(const Box& box) const { return around(box.size_m / 2.0); }
  Eigen::AlignedBox3d operator()(const Cylinder& cylinder) const {
    return around({cylinder.radius_m, cylinder.radius_m, cylinder.length_m / 2.0});
  }
  Eigen::AlignedBox3d operator()(const Sphere& sphere) const {
    return around(Eigen::Vector3d::Constant(sphere.radius_m));
  }
  Eigen::AlignedBox3d operator()(const Mesh& mesh) const {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : mesh.data->hull.vertices) box.extend(vertex);
    return box;
  }
};

}  // namespace

bool LinkInertia::is_possible() const {
  if (!(mass_kg > 0.0) || !p_LC.allFinite() || !I_C_kg_m2.allFinite()) return false;
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(I_C_kg_m2).eigenvalues();  // ascending
  const double rounding = 1e-9 * moments.cwiseAbs().sum();
  return moments[2] > 0.0 && moments[0] >= -rounding &&
         moments[2] <= moments[0] + moments[1] + rounding;
}

LinkInertia inertia_of_shapes(const std::vector<PlacedShape>& shapes, double density_kg_m3) {
  Eigen::AlignedBox3d box;
  for (const PlacedShape& placed : shapes) {
    box.extend(std::visit(BoundingBox{}, placed.shape).transformed(placed.X_LS));
  }
  LinkInertia total;
  if (box.isEmpty()) return total;

  const double cell_m = std::cbrt(box.volume() / kGridCells);
  const Eigen::Vector3i cells = (box.sizes() / cell_m).array().ceil().max(1.0).cast<int>();
  const Eigen::Vector3d side = box.sizes().cwiseQuotient(cells.cast<double>());
  const double cell_kg = density_kg_m3 * side.prod();
  const auto covered = [&](const Eigen::Vector3d& p_L) {
    return std::any_of(shapes.begin(), shapes.end(), [&](const PlacedShape& placed) {
      const Eigen::Vector3d p_S = placed.X_LS.inverse() * p_L;
      return std::visit(Contains{p_S}, placed.shape);
    });
  };
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   // sum of m p
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // sum of m p p'
  for (int x = 0; x < cells.x(); ++x) {
    for (int y = 0; y < cells.y(); ++y) {
      for (int z = 0; z < cells.z(); ++z) {
        const Eigen::Vector3d p =
            box.min() + side.cwiseProduct(Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5));
        if (!covered(p)) continue;
        total.mass_kg += cell_kg;
        first += cell_kg * p;
        second += cell_kg * p * p.transpose();
      }
    }
  }
  if (total.mass_kg <= 0.0) return total;
  total.p_LC = first / total.mass_kg;
  second -= total.mass_kg * total.p_LC * total.p_LC.transpose();
  // The cells themselves.
  second += (total.mass_kg / 12.0 * side.cwiseAbs2()).asDiagonal().toDenseMatrix();
  total.I_C_kg_m2 = second.trace() * Eigen::Matrix3d::Identity() - second;
  return total;
}

}  // namespace armloom
