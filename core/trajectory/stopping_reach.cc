#include "core/trajectory/stopping_reach.h"

#include <algorithm>
#include <vector>

namespace armloom {

double stopping_reach_s(const Cell& cell, const Trajectory& trajectory) {
  constexpr double kDecelerationMax_1_s = 50.0;  // as core/arm/rate_law.h has it
  constexpr double kDecelerationMin_1_s = 1e-3;
  const double duration_s = to_seconds(trajectory.duration());
  std::vector<double> deceleration;
  for (const SegmentBounds& bounds : trajectory.bounds()) {
    double least = kDecelerationMax_1_s;
    for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
      const auto row = static_cast<Eigen::Index>(j);
      const double spare = cell.joint(trajectory.joints()[j]).brake - bounds.acceleration[row];
      if (bounds.speed[row] * least > spare) least = spare / bounds.speed[row];
    }
    deceleration.push_back(std::max(least, kDecelerationMin_1_s));
  }
  double longest_s = 0.0;
  for (std::size_t i = 0; i < deceleration.size(); ++i) {
    // The weakest of all segments that it may pass says how many these are.
    double least = deceleration[i];
    const Segment& segment = trajectory.segments()[i];
    double passed_s = to_seconds(segment.start + segment.duration);
    for (std::size_t k = i + 1; k < deceleration.size(); ++k) {
      if (to_seconds(trajectory.segments()[k].start) > passed_s + 0.5 / least) break;
      least = std::min(least, deceleration[k]);
    }
    longest_s = std::max(longest_s, 0.5 / least);
  }
  return std::min(longest_s, duration_s);
}

}  // namespace armloom
