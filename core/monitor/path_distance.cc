#include "core/monitor/path_distance.h"

#include <algorithm>
#include <cmath>

namespace armloom {
namespace {

// Sampled positions on the searched part of a path; between them the path is nearly straight.
constexpr Duration kSample = std::chrono::milliseconds(5);
constexpr int kSamplesMax = 64;
constexpr int kHalvings = 12;

class PathPoints {
 public:
  PathPoints(const Trajectory& motion, const std::vector<JointId>& joints,
             const Configuration& measured)
      : motion_(motion), measured_(measured) {
    for (std::size_t row = 0; row < motion.joints().size(); ++row) {
      if (std::ranges::count(joints, motion.joints()[row]) > 0) rows_.push_back(row);
    }
  }
  PathDistance at(Duration progress) {
    motion_.sample_positions(progress, path_);
    PathDistance far{0.0, rows_.empty() ? JointId{0} : motion_.joints()[rows_.front()], progress};
    for (const std::size_t row : rows_) {
      const JointId joint = motion_.joints()[row];
      const double away =
          std::abs(measured_[joint.value()] - path_[static_cast<Eigen::Index>(row)]);
      if (away > far.distance) far = {away, joint, progress};
    }
    return far;
  }

 private:
  const Trajectory& motion_;
  const Configuration& measured_;
  std::vector<std::size_t> rows_;
  Eigen::VectorXd path_;
};

}  // namespace

PathDistance distance_from_path(const Trajectory& motion, const std::vector<JointId>& joints,
                                Duration from, Duration to, const Configuration& measured,
                                double enough) {
  PathPoints points(motion, joints, measured);
  PathDistance best = points.at(from);
  if (best.distance <= enough || to <= from) return best;
  const auto count = std::clamp<std::int64_t>((to - from) / kSample + 1, 1, kSamplesMax);
  Duration step = (to - from) / count;
  for (std::int64_t i = 1; i <= count; ++i) {
    const PathDistance one = points.at(i == count ? to : from + i * step);
    if (one.distance < best.distance) best = one;
    if (best.distance <= enough) return best;
  }
  for (int i = 0; i < kHalvings && step > Duration{1}; ++i) {
    step /= 2;
    for (const Duration progress : {best.progress - step, best.progress + step}) {
      if (progress < from || progress > to) continue;
      const PathDistance one = points.at(progress);
      if (one.distance < best.distance) best = one;
    }
    if (best.distance <= enough) return best;
  }
  return best;
}

}  // namespace armloom
