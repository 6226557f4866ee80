#pragma once

#include <Eigen/Core>

namespace armloom {

// A segment from center - half to center + half; a point when half is zero.
struct CenteredSegment {
  Eigen::Vector3d center;
  Eigen::Vector3d half;
};

// Distance of two segments (m). Exact but for rounding (about 1e-15; 1e-7 when the segments are
// parallel to within 1e-7 rad). After C. Ericson, "Real-Time Collision Detection", 5.1.9.
[[nodiscard]] double segment_segment_distance(const CenteredSegment& a, const CenteredSegment& b);
// From its nearest point on b to that on a.
[[nodiscard]] Eigen::Vector3d segment_segment_gap(const CenteredSegment& a,
                                                  const CenteredSegment& b);

// Distance of a segment from a solid box that is centred in the segment's frame and aligned with
// its axes; zero where they touch. Exact but for rounding: the squared distance is convex and
// piecewise quadratic along the segment, so its minimum is the zero of a piecewise linear
// derivative with at most six breakpoints.
[[nodiscard]] double segment_box_distance(const CenteredSegment& segment,
                                          const Eigen::Vector3d& half_size_m);

}  // namespace armloom
