#include "test/soundness/pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/trajectory/polynomial.h"
#include "core/trajectory/validate.h"

namespace armloom::soundness {
namespace {

constexpr double kLimitShare = 0.9;
constexpr double kRangeShare = 0.9;
constexpr double kKnot_s = 0.1;
constexpr double kSameSide = 0.03;  // so that some pairs collide and most do not

// A joint's position: middle + sum of c[k] cos(k w t). c[5] and c[6] make the accelerations zero at
// both ends.
struct Wave {
  double middle = 0.0;
  double w = 0.0;
  std::array<double, 7> c{};

  [[nodiscard]] KnotState at(double t_s) const {
    KnotState state{middle, 0.0, 0.0};
    for (std::size_t k = 1; k < c.size(); ++k) {
      const double kw = static_cast<double>(k) * w;
      state.position += c[k] * std::cos(kw * t_s);
      state.velocity -= c[k] * kw * std::sin(kw * t_s);
      state.acceleration -= c[k] * kw * kw * std::cos(kw * t_s);
    }
    return state;
  }
};

Wave random_wave(const Joint& joint, double duration_s, double turn_rad, std::mt19937_64& random) {
  Wave wave;
  wave.w = std::numbers::pi / duration_s;
  for (std::size_t k = 1; k <= 4; ++k) wave.c[k] = uniform(random, -1.0, 1.0);
  wave.c[5] = -(wave.c[1] + 9.0 * wave.c[3]) / 25.0;
  wave.c[6] = -(4.0 * wave.c[2] + 16.0 * wave.c[4]) / 36.0;
  double low = 0.0, high = 0.0, velocity = 0.0, acceleration = 0.0;
  for (int i = 0; i <= 500; ++i) {
    const KnotState state = wave.at(duration_s * i / 500.0);
    low = std::min(low, state.position);
    high = std::max(high, state.position);
    velocity = std::max(velocity, std::abs(state.velocity));
    acceleration = std::max(acceleration, std::abs(state.acceleration));
  }
  const double center = (joint.lower + joint.upper) / 2.0;
  const double half = kRangeShare * (joint.upper - joint.lower) / 2.0;
  const double scale = std::min({uniform(random, 0.1, 0.45) * 2.0 * half / (high - low),
                                 kLimitShare * joint.velocity_max / velocity,
                                 kLimitShare * joint.acceleration_max / acceleration});
  for (double& c : wave.c) c *= scale;
  const double least = center - half - scale * low;
  const double most = center + half - scale * high;
  wave.middle =
      turn_rad == 0.0 ? uniform(random, least, most) : std::clamp(center + turn_rad, least, most);
  return wave;
}

bool keeps_clear(bench::ExactScene& exact, const Trajectory& motion) {
  const double margin_m = exact.cell().clearances.clearance_m + 0.002;
  Configuration q = exact.cell().home();
  Eigen::VectorXd position;
  for (Duration t{}; t <= motion.duration(); t += std::chrono::milliseconds(20)) {
    motion.sample_positions(t, position);
    for (std::size_t j = 0; j < motion.joints().size(); ++j) {
      q[static_cast<Eigen::Index>(motion.joints()[j].index())] =
          position[static_cast<Eigen::Index>(j)];
    }
    if (exact.to_scene(q, margin_m) < margin_m || exact.self_too_close(q)) return false;
  }
  return true;
}

double progress_at(const Motion& motion, double t_s, double ahead_s) {
  const double now = std::max(to_seconds(motion.progress), 0.0);
  const double end = to_seconds(motion.trajectory->duration());
  return std::clamp(to_seconds(motion.progress) + t_s + ahead_s, std::min(now, end), end);
}

void put(const Motion& motion, double progress_s, Configuration& q) {
  thread_local Eigen::VectorXd position;
  motion.trajectory->sample_positions(from_seconds(progress_s), position);
  for (std::size_t j = 0; j < motion.trajectory->joints().size(); ++j) {
    q[static_cast<Eigen::Index>(motion.trajectory->joints()[j].index())] =
        position[static_cast<Eigen::Index>(j)];
  }
}

}  // namespace

double uniform(std::mt19937_64& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

TrajectoryPtr swing(const Cell& cell, ArmId arm, Duration duration, double turn_rad,
                    std::mt19937_64& random) {
  const double duration_s = to_seconds(duration);
  std::vector<Wave> waves;
  TrajectoryRequest request;
  for (const JointId id : cell.arm(arm).joints) {
    waves.push_back(
        random_wave(cell.joint(id), duration_s, waves.empty() ? turn_rad : 0.0, random));
    request.joint_names.push_back(cell.joint(id).name);
  }
  const int knots = static_cast<int>(std::lround(duration_s / kKnot_s));
  for (int i = 0; i <= knots; ++i) {
    WaypointRequest point;
    point.time_from_start_s = duration_s * i / knots;
    for (const Wave& wave : waves) {
      const KnotState state = wave.at(point.time_from_start_s);
      point.positions.push_back(state.position);
      point.velocities.push_back(state.velocity);
      point.accelerations.push_back(state.acceleration);
    }
    request.points.push_back(std::move(point));
  }
  auto trajectory = validate(request, cell);
  if (!trajectory) throw std::runtime_error("swing: " + trajectory.error()[0].detail);
  return *trajectory;
}

Pool::Pool(bench::ExactScene& exact, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (std::uint32_t arm = 0; arm < 2; ++arm) {
    while (motions[arm].size() < count) {
      const double side = motions[arm].size() % 2 == 0 ? -1.0 : 1.0;
      const double duration_s =
          random() % 2 == 0 ? 10.0 : 0.1 * std::floor(10.0 * uniform(random, 2.0, 10.0));
      const double turn_rad = side * uniform(random, 1.6, 2.6);
      TrajectoryPtr motion =
          swing(exact.cell(), ArmId{arm}, from_seconds(duration_s), turn_rad, random);
      if (keeps_clear(exact, *motion)) {
        motions[arm].push_back(std::move(motion));
      } else {
        ++refused;
      }
    }
  }
}

Question MovingPair::question(const Cell& cell, const CheckMethod& method) const {
  return {7, TimePoint{}, {candidate}, {other}, cell.home(), method};
}

double MovingPair::span_s() const {
  return to_seconds(std::max(candidate.remaining(), other.remaining()));
}

void MovingPair::state_at(double t_s, double ahead_candidate_s, double ahead_other_s,
                          Configuration& q) const {
  put(candidate, progress_at(candidate, t_s, ahead_candidate_s), q);
  put(other, progress_at(other, t_s, ahead_other_s), q);
}

std::vector<MovingPair> random_pairs(bench::ExactScene& exact, const Pool& pool, std::size_t count,
                                     std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<MovingPair> pairs;
  Configuration q = exact.cell().home();
  const double least_m = exact.cell().clearances.clearance_m + 0.001;
  while (pairs.size() < count) {
    const std::size_t arm = random() % 2;
    // The arms face each other: equal rotations move them apart.
    const std::size_t turn = random() % 2;
    const std::size_t other_turn = uniform(random, 0.0, 1.0) < kSameSide ? 1 - turn : turn;
    const auto any = [&](std::size_t of, std::size_t turned) {
      return pool.motions[of][2 * (random() % (pool.motions[of].size() / 2)) + turned];
    };
    MovingPair pair{{StepId{JobId{1}}, any(arm, turn), {}},
                    {StepId{JobId{2}}, any(1 - arm, other_turn), {}}};
    if (random() % 2 == 0) pair.candidate.progress = from_seconds(uniform(random, -3.0, 0.0));
    if (random() % 2 == 0) {
      const double end = to_seconds(pair.other.trajectory->duration());
      pair.other.progress = from_seconds(uniform(random, -2.0, 0.9 * end));
    }
    pair.state_at(0.0, 0.0, 0.0, q);
    if (exact.between_arms(q, least_m) >= least_m) pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace armloom::soundness
