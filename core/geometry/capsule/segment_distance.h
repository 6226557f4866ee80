#pragma once

#include <Eigen/Core>

namespace armloom {

// A segment from center - half to center + half; a point when half is zero.
struct CenteredSegment {
  Eigen::Vector3d center;
  Eigen::Vector3d half;
};

// Returns the distance of two segments (m). Exact except for rounding (about 1e-15; 1e-7 if the
// segments are parallel to within 1e-7 rad). C. Ericson, "Real-Time Collision Detection", 5.1.9.
[[nodiscard]] double segment_segment_distance(const CenteredSegment& a, const CenteredSegment& b);
// Returns the vector from the nearest point on b to that on a.
[[nodiscard]] Eigen::Vector3d segment_segment_gap(const CenteredSegment& a,
                                                  const CenteredSegment& b);

// Returns the distance of a segment from a solid box at the origin, aligned with the axes; zero in
// contact. Exact except for rounding: the squared distance along the segment is convex and
// piecewise quadratic, so its derivative is piecewise linear with at most six breakpoints.
[[nodiscard]] double segment_box_distance(const CenteredSegment& segment,
                                          const Eigen::Vector3d& half_size_m);

}  // namespace armloom
