#include "core/trajectory/stopping_reach.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace armloom {
namespace {

constexpr double kDecelerationMax_1_s = 50.0;  // as in core/trajectory/rate_law.h
constexpr double kDecelerationMin_1_s = 1e-3;

// Long segments are divided into stretches: a joint's top speed and acceleration rarely coincide.
constexpr double kStretch_s = 0.05;
constexpr double kStretchesMax = 32.0;  // largest number of stretches of a segment

struct Stretch {
  double from_s;
  double to_s;
  double deceleration_1_s;  // possible in every state of the stretch
};

double deceleration_on(const Cell& cell, const Trajectory& trajectory,
                       const SegmentBounds& bounds) {
  double least = kDecelerationMax_1_s;
  for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    const double spare = cell.joint(trajectory.joints()[j]).brake - bounds.acceleration[row];
    if (bounds.speed[row] * least > spare) least = spare / bounds.speed[row];
  }
  return std::max(least, kDecelerationMin_1_s);
}

std::vector<Stretch> stretches_of(const Cell& cell, const Trajectory& trajectory) {
  std::vector<Stretch> stretches;
  for (std::size_t s = 0; s < trajectory.segment_count(); ++s) {
    const Segment segment = trajectory.segment(s);
    const double begin_s = to_seconds(segment.start);
    const double long_s = to_seconds(segment.duration);
    const double count = std::clamp(std::ceil(long_s / kStretch_s), 1.0, kStretchesMax);
    for (double i = 0.0; i < count; i += 1.0) {
      const double from_s = long_s * i / count;
      const double to_s = long_s * (i + 1.0) / count;
      stretches.push_back({begin_s + from_s, begin_s + to_s,
                           deceleration_on(cell, trajectory, bounds_of(segment, from_s, to_s))});
    }
  }
  return stretches;
}

}  // namespace

double stopping_reach_s(const Cell& cell, const Trajectory& trajectory) {
  const std::vector<Stretch> stretches = stretches_of(cell, trajectory);
  double longest_s = 0.0;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    // The weakest deceleration determines how many stretches may be passed.
    double least = stretches[i].deceleration_1_s;
    for (std::size_t k = i + 1; k < stretches.size(); ++k) {
      if (stretches[k].from_s > stretches[i].to_s + 0.5 / least) break;
      least = std::min(least, stretches[k].deceleration_1_s);
    }
    longest_s = std::max(longest_s, 0.5 / least);
  }
  return std::min(longest_s, to_seconds(trajectory.duration()));
}

}  // namespace armloom
