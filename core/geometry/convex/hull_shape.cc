#include "core/geometry/convex/hull_shape.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace armloom {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Eigen::AlignedBox3d box_in(const Points& points, const Eigen::Matrix3d& R) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(Eigen::Vector3d(R.transpose() * p));
  return box;
}

Eigen::Matrix3d principal_axes(const Points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) covariance += (p - mean) * (p - mean).transpose();
  Eigen::Matrix3d R = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  if (R.determinant() < 0.0) R.col(0) = -R.col(0);
  return R;
}

// Returns the axes in the same cyclic order, with the box's longest side along z.
Eigen::Matrix3d turned_to_z(const Eigen::Matrix3d& R, const Eigen::Vector3d& sizes) {
  Eigen::Index longest = 0;
  sizes.maxCoeff(&longest);
  Eigen::Matrix3d turned;
  for (Eigen::Index i = 0; i < 3; ++i) turned.col(i) = R.col((i + longest + 1) % 3);
  return turned;
}

void list_neighbors(HullShape& shape) {
  std::vector<std::set<std::uint32_t>> of(shape.hull.vertices.size());
  for (const Triangle& face : shape.hull.faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      of[face[i]].insert(face[(i + 1) % 3]);
      of[face[(i + 1) % 3]].insert(face[i]);
    }
  }
  for (const std::set<std::uint32_t>& neighbors : of) {
    shape.neighbors.insert(shape.neighbors.end(), neighbors.begin(), neighbors.end());
    shape.neighbors_end.push_back(static_cast<std::uint32_t>(shape.neighbors.size()));
  }
}

}  // namespace

HullShape fit_hull(const ConvexHull& hull_M) {
  const Points& points = hull_M.vertices;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d principal = principal_axes(points);
  if (box_in(points, principal).volume() < box_in(points, R).volume()) R = principal;
  R = turned_to_z(R, box_in(points, R).sizes());
  const Eigen::AlignedBox3d box = box_in(points, R);

  HullShape shape;
  shape.X_MS = Eigen::Isometry3d::Identity();
  shape.X_MS.linear() = R;
  shape.X_MS.translation() = R * box.center();
  shape.hull.faces = hull_M.faces;
  const Eigen::Isometry3d X_SM = shape.X_MS.inverse();
  shape.half_size_m.setZero();
  for (const Eigen::Vector3d& p_M : points) {
    const Eigen::Vector3d p = X_SM * p_M;
    shape.hull.vertices.push_back(p);
    // The bounds are computed from the stored corners, so that rounding is on the safe side.
    shape.half_size_m = shape.half_size_m.cwiseMax(p.cwiseAbs());
    shape.radius_m = std::max(shape.radius_m, std::hypot(p.x(), p.y()));
  }
  for (const Eigen::Vector3d& p : shape.hull.vertices) {
    const double beside = std::hypot(p.x(), p.y());
    const double cap =
        std::sqrt(std::max(0.0, (shape.radius_m - beside) * (shape.radius_m + beside)));
    shape.half_length_m = std::max(shape.half_length_m, std::abs(p.z()) - cap);
  }
  list_neighbors(shape);
  shape.radius_m *= 1.0 + 4.0 * std::numeric_limits<double>::epsilon();
  return shape;
}

double HullShape::support(const Eigen::Vector3d& n_S) const {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : hull.vertices) largest = std::max(largest, n_S.dot(p));
  return largest;
}

std::uint32_t HullShape::uphill(const Eigen::Vector3d& n_S, std::uint32_t from) const {
  std::uint32_t best = from;
  double largest = n_S.dot(hull.vertices[from]);
  do {
    from = best;
    for (std::uint32_t k = from == 0 ? 0 : neighbors_end[from - 1]; k < neighbors_end[from]; ++k) {
      const double along = n_S.dot(hull.vertices[neighbors[k]]);
      if (along <= largest) continue;
      largest = along;
      best = neighbors[k];
    }
  } while (best != from);
  return best;
}

}  // namespace armloom
