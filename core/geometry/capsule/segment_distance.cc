#include "core/geometry/capsule/segment_distance.h"

#include <algorithm>
#include <cmath>

namespace armloom {
namespace {

constexpr double kPoint_m2 = 1e-24;  // squared length below which a segment is a point

struct Outside {
  double squared;     // squared distance from the box
  double derivative;  // half of d(squared)/ds
};

Outside outside_at(const Eigen::Vector3d& p, const Eigen::Vector3d& d,
                   const Eigen::Vector3d& half_size) {
  Outside sum{0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    const double excess = std::abs(p[i]) - half_size[i];
    if (excess <= 0.0) continue;
    sum.squared += excess * excess;
    sum.derivative += excess * std::copysign(d[i], p[i] * d[i]);
  }
  return sum;
}

}  // namespace

Eigen::Vector3d segment_segment_gap(const CenteredSegment& a, const CenteredSegment& b) {
  // Both parameters run from -1 to 1: p(s) = a.center + s a.half, r(t) = b.center + t b.half.
  const Eigen::Vector3d w = a.center - b.center;
  const double aa = a.half.squaredNorm();
  const double bb = b.half.squaredNorm();
  const double ab = a.half.dot(b.half);
  const double aw = a.half.dot(w);
  const double bw = b.half.dot(w);
  const auto nearest_on_a = [&](double t) {
    return aa <= kPoint_m2 ? 0.0 : std::clamp((ab * t - aw) / aa, -1.0, 1.0);
  };
  const double denominator = aa * bb - ab * ab;
  double s = 0.0;
  if (denominator > 1e-15 * aa * bb) {
    s = std::clamp((ab * bw - aw * bb) / denominator, -1.0, 1.0);
  }
  double t = 0.0;
  if (bb > kPoint_m2) t = std::clamp((ab * s + bw) / bb, -1.0, 1.0);
  s = nearest_on_a(t);
  return w + s * a.half - t * b.half;
}

double segment_segment_distance(const CenteredSegment& a, const CenteredSegment& b) {
  return segment_segment_gap(a, b).norm();
}

double segment_box_distance(const CenteredSegment& segment, const Eigen::Vector3d& half_size_m) {
  const Eigen::Vector3d p0 = segment.center - segment.half;
  const Eigen::Vector3d d = 2.0 * segment.half;
  const Outside first = outside_at(p0, d, half_size_m);
  if (first.derivative >= 0.0) return std::sqrt(first.squared);
  const Outside last = outside_at(p0 + d, d, half_size_m);
  if (last.derivative <= 0.0) return std::sqrt(last.squared);

  // The derivative never decreases along the segment, so each breakpoint narrows the interval that
  // contains the zero of the derivative.
  double left = 0.0;
  double right = 1.0;
  double slope_left = first.derivative;
  double slope_right = last.derivative;
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0.0) continue;
    for (const double side : {-half_size_m[i], half_size_m[i]}) {
      const double s = (side - p0[i]) / d[i];
      if (s <= left || s >= right) continue;
      const double slope = outside_at(p0 + s * d, d, half_size_m).derivative;
      (slope < 0.0 ? left : right) = s;
      (slope < 0.0 ? slope_left : slope_right) = slope;
    }
  }
  const double s = left + (right - left) * (-slope_left / (slope_right - slope_left));
  return std::sqrt(outside_at(p0 + s * d, d, half_size_m).squared);
}

}  // namespace armloom
