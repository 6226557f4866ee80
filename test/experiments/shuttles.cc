#include "test/experiments/shuttles.h"

#include <array>
#include <span>

namespace armloom::experiments {
namespace {

using Pose = std::array<double, 7>;  // rad

// Of panda_two, as published with the planning environments of mr_planner: poses whose straight
// move from home keeps 4 cm from the other arm at its home and from the table. Its panda1 is left.
// ready, twist_left, twist_right, mirror, left_push, coop_up, coop_down, tiled_up, tiled_down
constexpr Pose kLeft[] = {
    {0.0, -0.5, 0.0, -1.5, 0.0, 1.0, 0.0},
    {-1.4202, 1.0485, 0.284, -1.5, 2.2535, 1.0, 0.0},
    {0.2949, 0.3483, 0.7806, -1.6474, 0.0, 2.094, 0.0},
    {-0.25, 0.0, -0.312, -2.0262, 1.2481, 0.7075, 0.0},
    {1.5, -0.3, 0.0, -2.0, 0.0, 1.8, 0.0},
    {0.0, -0.7, 0.0, -1.8, 0.0, 2.6, 0.0},
    {0.0, -0.5, 0.0, -2.9, 0.0, 2.4, 0.0},
    {0.0, -0.25, 0.0, -1.6, 0.0, 2.7, 0.0},
    {0.0, -0.3, 0.0, -2.0, 0.0, 0.8, 0.0},
};
// ready, twist_left, twist_right, mirror, right_push, coop_up, coop_down, tiled_down
constexpr Pose kRight[] = {
    {0.0, -0.5, 0.0, -1.5, 0.0, 1.0, 0.0},
    {0.2949, 0.3483, 0.7807, -1.6474, 0.0, 2.082, 0.0},
    {-1.4201, 1.0485, 0.2839, -1.5, 2.2535, 1.0, 0.0},
    {-0.25, 0.0, -0.312, -2.0231, 1.2481, 0.7015, 0.0},
    {1.5, -0.3, 0.0, -2.0, 0.0, 1.8, 0.0},
    {0.0, -0.7, 0.0, -1.8, 0.0, 2.6, 0.0},
    {0.0, -0.5, 0.0, -2.9, 0.0, 2.4, 0.0},
    {0.0, 0.0, 0.0, -2.6, 0.0, 2.5, 0.0},
};
constexpr int kMoreTrips = 10;
constexpr int kFewerTrips = 8;

}  // namespace

std::vector<PlannedJob> shuttle_jobs(const CellPtr& cell, std::uint64_t seed) {
  JobMaker maker(cell, seed);
  const std::array<std::span<const Pose>, 2> poses = {kLeft, kRight};
  for (std::uint32_t i = 0; i < poses.size(); ++i) {
    const ArmId arm(i);
    const int trips = seed % 2 == 1 - i ? kMoreTrips : kFewerTrips;
    for (int trip = 0; trip < trips; ++trip) {
      const Pose& drawn = poses[i][maker.random()() % poses[i].size()];
      const Eigen::VectorXd pose = Eigen::VectorXd::Map(drawn.data(), drawn.size());
      maker.add_trip(arm, {{"out", {{pose}}}, {"home", {{maker.home(arm)}}}});
    }
  }
  return maker.take(2);
}

}  // namespace armloom::experiments
