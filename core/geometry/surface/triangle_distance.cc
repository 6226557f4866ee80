#include "core/geometry/surface/triangle_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace armloom {
namespace {

using Eigen::Vector3d;

// A distance is proven if its lower and upper bound differ by less than this (m).
constexpr double kProven = 1e-10;
// Smaller squared normals are meaningless because of rounding.
constexpr double kLeastSquare = 1e-60;

// Keeps the largest gap proven so far, and the smallest distance of two points found so far.
class Search {
 public:
  Search(const TrianglePoints& a, const TrianglePoints& b, double limit_m)
      : a_(a), b_(b), limit_m_(limit_m) {}

  // Tries a direction that may separate the triangles. Returns true if the result is final.
  bool try_direction(const Vector3d& from_a_to_b, double length) {
    const double a = std::max({from_a_to_b.dot(a_[0]), from_a_to_b.dot(a_[1]),  //
                               from_a_to_b.dot(a_[2])});
    const double b = std::min({from_a_to_b.dot(b_[0]), from_a_to_b.dot(b_[1]),  //
                               from_a_to_b.dot(b_[2])});
    if (const double gap = (b - a) / length; gap > proven_) {
      proven_ = gap;
      direction_ = from_a_to_b;
      length_ = length;
    }
    return proven_ >= limit_m_ || proven_ >= claimed_ - kProven;
  }

  bool try_points(const Vector3d& p_a, const Vector3d& p_b) {
    const Vector3d gap = p_b - p_a;
    const double squared = gap.squaredNorm();
    if (squared >= claimed_squared_) return false;
    claimed_squared_ = squared;
    claimed_ = std::sqrt(squared);
    if (!(claimed_ > kProven)) return true;  // in contact
    return try_direction(gap, claimed_);
  }

  [[nodiscard]] TriangleGap result() const {
    return {std::min(proven_, limit_m_), direction_ / length_};
  }

 private:
  const TrianglePoints& a_;
  const TrianglePoints& b_;
  double limit_m_;
  double claimed_squared_ = std::numeric_limits<double>::infinity();
  double claimed_ = std::numeric_limits<double>::infinity();
  double proven_ = 0.0;
  Vector3d direction_ = Vector3d::Zero();  // the planes across it have the gap proven_
  double length_ = 1.0;
};

// Tries the nearest points of two edges, p + s u and q + t v with s and t from 0 to 1 (Ericson,
// "Real-Time Collision Detection", 5.1.9).
bool try_edges(const Vector3d& p, const Vector3d& u, const Vector3d& q, const Vector3d& v,
               Search& search) {
  const Vector3d r = p - q;
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double ur = u.dot(r);
  const double vr = v.dot(r);
  const double det = uu * vv - uv * uv;
  const auto clamped = [](double numerator, double denominator) {
    return denominator > 0.0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0.0;
  };
  double s = clamped(uv * vr - ur * vv, det);
  double t = clamped(uv * s + vr, vv);
  s = clamped(uv * t - ur, uu);
  t = clamped(uv * s + vr, vv);
  return search.try_points(p + s * u, q + t * v);
}

// Tries the face's normal if the other triangle is completely on one side of the face's plane. Then
// tries its corner nearest to the plane, if the projection of this corner is on the face.
bool try_face(const TrianglePoints& face, const TrianglePoints& other, bool face_is_a,
              Search& search) {
  const Vector3d normal = (face[1] - face[0]).cross(face[2] - face[0]);
  const double squared = normal.squaredNorm();
  if (!(squared > kLeastSquare)) return false;
  double height[3];
  for (std::size_t i = 0; i < 3; ++i) height[i] = normal.dot(other[i] - face[0]);
  const bool above = height[0] > 0.0 && height[1] > 0.0 && height[2] > 0.0;
  const bool below = height[0] < 0.0 && height[1] < 0.0 && height[2] < 0.0;
  if (!above && !below) return false;
  const Vector3d away = face_is_a == above ? normal : Vector3d(-normal);
  if (search.try_direction(away, std::sqrt(squared))) return true;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(height[i]) < std::abs(height[nearest])) nearest = i;
  }
  const Vector3d& p = other[nearest];
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d edge = face[(i + 1) % 3] - face[i];
    if (normal.dot(edge.cross(p - face[i])) < 0.0) return false;
  }
  const Vector3d foot = p - height[nearest] / squared * normal;
  return face_is_a ? search.try_points(foot, p) : search.try_points(p, foot);
}

}  // namespace

double triangle_distance(const TrianglePoints& a, const TrianglePoints& b, double limit_m) {
  return triangle_gap(a, b, limit_m).distance_m;
}

TriangleGap triangle_gap(const TrianglePoints& a, const TrianglePoints& b, double limit_m) {
  Search search(a, b, limit_m);
  if (try_face(a, b, true, search) || try_face(b, a, false, search)) return search.result();
  const TrianglePoints edges_a{a[1] - a[0], a[2] - a[1], a[0] - a[2]};
  const TrianglePoints edges_b{b[1] - b[0], b[2] - b[1], b[0] - b[2]};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (try_edges(a[i], edges_a[i], b[j], edges_b[j], search)) return search.result();
    }
  }
  return search.result();
}

}  // namespace armloom
