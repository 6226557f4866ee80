#include "test/scheduler/stretches.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace armloom {
namespace {

constexpr Duration kLarger = std::chrono::microseconds(1);

Eigen::Index row_of(const Trajectory& motion, ArmId arm) {
  return std::ranges::find(motion.arms(), arm) - motion.arms().begin();
}

// Returns the share of its duration after which a quintic from rest to rest has covered `way_share`
// of its distance.
double time_share(double way_share) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 45; ++i) {
    const double t = 0.5 * (low + high);
    (t * t * t * (10.0 + t * (-15.0 + t * 6.0)) < way_share ? low : high) = t;
  }
  return 0.5 * (low + high);
}

}  // namespace

double place_of(const Trajectory& motion, ArmId arm, Duration progress) {
  Eigen::VectorXd position;
  motion.sample_positions(progress, position);
  return position[row_of(motion, arm)];
}

namespace {

// Returns nullopt if the motion never enters the stretch.
std::optional<Span> span_on_line(double start, double goal, Duration T, Stretch stretch) {
  if (std::max(start, goal) < stretch.from || std::min(start, goal) > stretch.to) {
    return std::nullopt;
  }
  if (std::abs(goal - start) < 1e-9) return Span{Duration{}, T};
  const double enters = ((goal > start ? stretch.from : stretch.to) - start) / (goal - start);
  const double leaves = ((goal > start ? stretch.to : stretch.from) - start) / (goal - start);
  const auto when = [&](double share) { return from_seconds(to_seconds(T) * time_share(share)); };
  Span span{Duration{}, T};
  if (enters > 0.0) span.from = std::max(Duration{}, when(enters) - kLarger);
  if (leaves < 1.0) span.to = std::min(T, when(leaves) + kLarger);
  return span;
}

}  // namespace

std::vector<Span> spans_in(const Trajectory& motion, ArmId arm, Stretch stretch) {
  std::vector<Span> spans;
  for (const Segment& line : motion.segments()) {
    const Duration end = line.start + line.duration;
    const auto span = span_on_line(place_of(motion, arm, line.start), place_of(motion, arm, end),
                                   line.duration, stretch);
    if (span) spans.push_back({line.start + span->from, line.start + span->to});
  }
  return spans;
}

}  // namespace armloom
