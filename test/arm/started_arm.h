#pragma once

#include "test/arm/arm_fixture.h"

namespace armloom {

struct Example {
  explicit Example(CellOptions options = {}, std::uint64_t seed = 1)
      : random(seed),
        cell(two_arm_cell(options)),
        trajectory(random_trajectory(*cell, joints_of(*cell, kLeft), {kLeft}, random)),
        bench(cell, kLeft, *trajectory, seed) {}

  void start_now(Duration from = {}) {
    bench.command.start(trajectory, bench.now, from, trajectory->duration());
  }
  // Returns how far the arm joints are from the path at `progress`.
  double off_path(const ArmFeedback& feedback, Duration progress) const {
    Eigen::VectorXd q;
    trajectory->sample_positions(progress, q);
    return (feedback.measured.head(7) - q).cwiseAbs().maxCoeff();
  }

  std::mt19937_64 random;
  CellPtr cell;
  TrajectoryPtr trajectory;
  Bench bench;
};

}  // namespace armloom
