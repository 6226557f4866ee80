#include "test/bench/motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "core/trajectory/polynomial.h"
#include "core/trajectory/validate.h"

namespace armloom::bench {
namespace {

constexpr int kCosines = 6;
constexpr double kVelocityShare = 0.6;
constexpr double kAccelerationShare = 0.8;

double uniform(std::mt19937_64& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

// A joint's position at time t: middle + sum of c[k] cos(k w t), k = 1..6, with w = pi / 10 s.
// Velocities are zero at both ends. c[5] and c[6] make the accelerations there zero (sums of k^2
// c[k] over odd and even k).
struct Swing {
  double middle = 0.0;
  std::array<double, kCosines + 1> c{};

  [[nodiscard]] KnotState at(double t_s) const {
    KnotState state{middle, 0.0, 0.0};
    for (int k = 1; k <= kCosines; ++k) {
      const double w = std::numbers::pi * k / kMotion_s;
      const double amplitude = c[static_cast<std::size_t>(k)];
      state.position += amplitude * std::cos(w * t_s);
      state.velocity -= amplitude * w * std::sin(w * t_s);
      state.acceleration -= amplitude * w * w * std::cos(w * t_s);
    }
    return state;
  }
};

struct Range {
  double low = 0.0;
  double high = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};

Range range_of(const Swing& swing) {
  Range range{swing.at(0.0).position, swing.at(0.0).position};
  for (int i = 0; i <= 1000; ++i) {
    const KnotState state = swing.at(kMotion_s * i / 1000.0);
    range.low = std::min(range.low, state.position);
    range.high = std::max(range.high, state.position);
    range.velocity = std::max(range.velocity, std::abs(state.velocity));
    range.acceleration = std::max(range.acceleration, std::abs(state.acceleration));
  }
  return range;
}

Swing random_swing(const Joint& joint, double reach, std::mt19937_64& random) {
  Swing swing;
  for (std::size_t k = 1; k <= 4; ++k) {
    swing.c[k] = uniform(random, -1.0, 1.0) / static_cast<double>(k);
  }
  swing.c[5] = -(swing.c[1] + 9.0 * swing.c[3]) / 25.0;
  swing.c[6] = -(4.0 * swing.c[2] + 16.0 * swing.c[4]) / 36.0;
  const Range raw = range_of(swing);
  const double center = (joint.lower + joint.upper) / 2.0;
  const double half = reach * (joint.upper - joint.lower) / 2.0;
  const double scale = std::min({uniform(random, 0.3, 1.0) * 2.0 * half / (raw.high - raw.low),
                                 kVelocityShare * joint.velocity_max / raw.velocity,
                                 kAccelerationShare * joint.acceleration_max / raw.acceleration});
  for (double& c : swing.c) c *= scale;
  swing.middle = uniform(random, center - half - scale * raw.low, center + half - scale * raw.high);
  return swing;
}

}  // namespace

TrajectoryPtr random_motion(const Cell& cell, ArmId arm, std::uint64_t seed, double reach) {
  std::mt19937_64 random(seed);
  std::vector<Swing> swings;
  TrajectoryRequest request;
  for (const JointId id : cell.arm(arm).joints) {
    swings.push_back(random_swing(cell.joint(id), reach, random));
    request.joint_names.push_back(cell.joint(id).name);
  }
  for (std::size_t i = 0; i < kWaypoints; ++i) {
    WaypointRequest point;
    point.time_from_start_s =
        kMotion_s * static_cast<double>(i) / static_cast<double>(kWaypoints - 1);
    for (const Swing& swing : swings) {
      const KnotState state = swing.at(point.time_from_start_s);
      point.positions.push_back(state.position);
      point.velocities.push_back(state.velocity);
      point.accelerations.push_back(state.acceleration);
    }
    request.points.push_back(std::move(point));
  }
  auto trajectory = validate(request, cell);
  if (!trajectory) {
    throw std::runtime_error("motion of seed " + std::to_string(seed) + ": " +
                             trajectory.error()[0].detail);
  }
  return *trajectory;
}

std::optional<TrajectoryPtr> from_home(const Cell& cell, ArmId arm, const Trajectory& motion,
                                       double share, bool backwards) {
  TrajectoryRequest request;
  for (const JointId id : motion.joints()) request.joint_names.push_back(cell.joint(id).name);
  JointState state;
  for (std::size_t i = 0; i < kWaypoints; ++i) {
    const double at_s = kMotion_s * static_cast<double>(i) / static_cast<double>(kWaypoints - 1);
    motion.sample(from_seconds(backwards ? kMotion_s - at_s : at_s), state);
    WaypointRequest point{{}, {}, {}, at_s};
    for (Eigen::Index j = 0; j < state.position.size(); ++j) {
      point.positions.push_back(cell.arm(arm).home[j] +
                                share * (state.position[j] - motion.start()[j]));
      point.velocities.push_back((backwards ? -share : share) * state.velocity[j]);
      point.accelerations.push_back(share * state.acceleration[j]);
    }
    request.points.push_back(std::move(point));
  }
  auto trajectory = validate(request, cell);
  if (!trajectory) return std::nullopt;
  return *trajectory;
}

void Motions::state_at(Duration progress, Configuration& q) const {
  state_at(progress, 0, Duration{0}, q);
}

void Motions::state_at(Duration progress, std::size_t i, Duration lead, Configuration& q) const {
  q = rest;
  thread_local Eigen::VectorXd position;
  for (std::size_t m = 0; m < trajectories.size(); ++m) {
    const Trajectory& trajectory = *trajectories[m];
    trajectory.sample_positions(m == i ? progress + lead : progress, position);
    for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
      q[static_cast<Eigen::Index>(trajectory.joints()[j].index())] =
          position[static_cast<Eigen::Index>(j)];
    }
  }
}

double closest_in_band(ExactScene& exact, const Motions& motions, const SampledBand& sampled,
                       double horizon_m, double enough_m) {
  const auto [step, band] = sampled;
  double smallest = horizon_m;
  Configuration q;
  const Duration end = motions.trajectories.at(0)->duration();
  for (Duration t{0}; t <= end; t += step) {
    for (Duration lead = -band; lead <= band; lead += step) {
      motions.state_at(t, 0, lead, q);
      smallest = exact.between_arms(q, smallest);
      if (smallest < enough_m) return smallest;
    }
  }
  return smallest;
}

bool clear_of_all_but_arms(ExactScene& exact, const Motions& motions, Duration step,
                           double margin_m) {
  Configuration q;
  const Duration end = motions.trajectories.at(0)->duration();
  for (Duration t{0}; t <= end; t += step) {
    motions.state_at(t, q);
    if (exact.to_scene(q, margin_m) < margin_m || exact.self_too_close(q, margin_m)) return false;
  }
  return true;
}

}  // namespace armloom::bench
