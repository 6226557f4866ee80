#pragma once

#include <optional>
#include <vector>

#include "test/soundness/pairs.h"

namespace armloom::soundness {

// Distances of a pair's arms by exact shapes (bench::ExactScene, in double) at every multiple of
// kSample from the question's time until both rest.
struct Truth {
  double smallest_m;  // the horizon if never below it; negative by the penetration depth if known
  double smallest_at_s;
  std::optional<double> first_below_s;  // the first sample closer than the cell's clearance
  std::size_t looked_at = 0;            // samples whose distance was computed
};
inline constexpr double kSample_s = 0.0005;
inline constexpr double kHorizon_m = 0.10;

// Returns by JointId how far any point of an arm can travel per unit of that joint's motion (m/rad;
// 1 for prismatic joints), in any configuration: the stretched-out length beyond the joint. Shares
// no code with the engine's motion bounds.
[[nodiscard]] std::vector<double> longest_levers(const PlanningScene& scene);

class TruthSampler {
 public:
  explicit TruthSampler(bench::ExactScene& exact);

  // Returns the same result as of_every_sample(). Skips samples that cannot change the result:
  // speed bounds times levers exclude that the arms came so close.
  [[nodiscard]] Truth of(const MovingPair& pair);
  // Evaluates every sample.
  [[nodiscard]] Truth of_every_sample(const MovingPair& pair);

 private:
  double at(const MovingPair& pair, double t_s, double horizon_m);

  bench::ExactScene& exact_;
  std::vector<double> levers_;
  Configuration q_;
};

}  // namespace armloom::soundness
