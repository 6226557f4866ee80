#pragma once

#include <optional>
#include <vector>

#include "test/soundness/pairs.h"

namespace armloom::soundness {

// What exact shapes (bench::ExactScene, in double) say of the two arms of a pair at every multiple
// of kSample from the question's instant until both rest.
struct Truth {
  double smallest_m;  // the horizon where never below it; negative by the depth where known
  double smallest_at_s;
  std::optional<double> first_below_s;  // the first sample closer than the cell's clearance
  std::size_t looked_at = 0;            // samples whose distance was computed
};
inline constexpr double kSample_s = 0.0005;
inline constexpr double kHorizon_m = 0.10;

// How far any point of an arm can travel, per unit of each joint's motion (m/rad; 1 for prismatic
// joints), whatever the configuration: the length of what the joint carries, stretched out. By
// JointId. Shares nothing with the engine's motion bounds.
[[nodiscard]] std::vector<double> longest_levers(const PlanningScene& scene);

class TruthSampler {
 public:
  explicit TruthSampler(bench::ExactScene& exact);

  // The result is that of looking at every sample: those that are skipped cannot change it, because
  // speed bounds times levers say that the arms cannot have come that close.
  [[nodiscard]] Truth of(const MovingPair& pair);
  // The same, really looking at every sample.
  [[nodiscard]] Truth of_every_sample(const MovingPair& pair);

 private:
  double at(const MovingPair& pair, double t_s, double horizon_m);

  bench::ExactScene& exact_;
  std::vector<double> levers_;
  Configuration q_;
};

}  // namespace armloom::soundness
