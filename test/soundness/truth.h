#pragma once

#include <optional>
#include <vector>

#include "test/soundness/pairs.h"

namespace armloom::soundness {

// Exact distances of a pair's arms (bench::ExactScene, double) at every multiple of kSample until
// both rest.
struct Truth {
  double smallest_m;  // the horizon if never below; negative in penetration
  double smallest_at_s;
  std::optional<double> first_below_s;  // the first sample closer than the cell's clearance
  std::size_t looked_at = 0;            // samples whose distance was computed
};
inline constexpr double kSample_s = 0.0005;
inline constexpr double kHorizon_m = 0.10;

// Returns by JointId how far any point can travel per unit of the joint's motion (m/rad; 1 for
// prismatic joints): the stretched-out length beyond the joint. Independent of the engine's motion
// bounds.
[[nodiscard]] std::vector<double> longest_levers(const PlanningScene& scene);

class TruthSampler {
 public:
  explicit TruthSampler(bench::ExactScene& exact);

  // Returns the same as of_every_sample(). Skips samples that cannot matter, as bounds of speed
  // times levers prove.
  [[nodiscard]] Truth of(const MovingPair& pair);
  [[nodiscard]] Truth of_every_sample(const MovingPair& pair);

 private:
  double at(const MovingPair& pair, double t_s, double horizon_m);

  bench::ExactScene& exact_;
  std::vector<double> levers_;
  Configuration q_;
};

}  // namespace armloom::soundness
