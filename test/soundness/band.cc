#include "test/soundness/band.h"

#include <algorithm>
#include <cmath>

#include "test/soundness/soundness.h"

namespace armloom::soundness {
namespace {

constexpr int kThrows = 60;
constexpr int kSteps = 160;

// The progress of each motion, as a share (0 to 1) of its remaining part, and each joint's
// deviation.
struct Point {
  double candidate = 0.0;
  double other = 0.0;
  std::vector<double> deviation;  // -1 to 1, by joint of the cell
};

class Attacker {
 public:
  Attacker(bench::ExactScene& exact, const MovingPair& pair, double tracking_error)
      : exact_(exact), pair_(pair), tracking_error_(tracking_error), q_(exact.cell().home()) {}

  Attack look(const Point& point, double horizon_m) {
    const double candidate_s = place(pair_.candidate, point.candidate);
    const double other_s = place(pair_.other, point.other);
    q_ = exact_.cell().home();
    pair_.state_at(0.0, candidate_s - to_seconds(pair_.candidate.progress),
                   other_s - to_seconds(pair_.other.progress), q_);
    for (std::size_t j = 0; j < point.deviation.size(); ++j) {
      q_[static_cast<Eigen::Index>(j)] += tracking_error_ * point.deviation[j];
    }
    return {exact_.between_arms(q_, horizon_m), candidate_s, other_s};
  }

 private:
  static double place(const Motion& motion, double share) {
    const double end = to_seconds(motion.trajectory->duration());
    const double now = std::clamp(to_seconds(motion.progress), 0.0, end);
    return now + share * (end - now);
  }

  bench::ExactScene& exact_;
  const MovingPair& pair_;
  double tracking_error_;
  Configuration q_;
};

double extreme_or_any(std::mt19937_64& random, double low, double high) {
  switch (random() % 4) {
    case 0:
      return low;
    case 1:
      return high;
    default:
      return uniform(random, low, high);
  }
}

}  // namespace

Attack attack(bench::ExactScene& exact, const MovingPair& pair, double tracking_error,
              double horizon_m, std::mt19937_64& random) {
  Attacker attacker(exact, pair, tracking_error);
  const std::size_t joints = exact.cell().joints.size();
  Attack best{horizon_m, 0.0, 0.0};
  Point at{0.0, 0.0, std::vector<double>(joints, 0.0)};
  const auto keep = [&](const Point& point) {
    const Attack seen = attacker.look(point, best.distance_m);
    if (seen.distance_m >= best.distance_m) return;
    best = seen;
    at = point;
  };
  for (int i = 0; i < kThrows; ++i) {
    Point point{(i + uniform(random, 0.0, 1.0)) / kThrows, extreme_or_any(random, 0.0, 1.0),
                std::vector<double>(joints)};
    for (double& d : point.deviation) d = extreme_or_any(random, -1.0, 1.0);
    keep(point);
  }
  if (best.distance_m >= horizon_m) return best;
  for (int i = 0; i < kSteps; ++i) {
    const double scale = std::pow(0.96, i);
    Point point = at;
    const auto move = [&](double& x, double low, double step) {
      x = std::clamp(x + uniform(random, -step, step) * scale, low, 1.0);
    };
    if (i % 3 != 1) {
      move(point.candidate, 0.0, 0.1);
      move(point.other, 0.0, 0.1);
    }
    if (i % 3 != 0) {
      const std::size_t j = random() % joints;
      point.deviation[j] = point.deviation[j] > 0.0 ? -1.0 : 1.0;
    }
    keep(point);
  }
  return best;
}

std::optional<MovingPair> hardly_free(const Verdict& regions, const MovingPair& pair) {
  const auto delayed = [&](double delay_s) {
    MovingPair later = pair;
    later.candidate.progress = pair.candidate.progress - from_seconds(delay_s);
    return later;
  };
  const auto is_free = [&](double delay_s) {
    return !first_in_regions_s(regions, delayed(delay_s));
  };
  double conflict_s = 0.0;
  if (is_free(conflict_s)) return std::nullopt;
  double free_s = 0.0;
  do {
    conflict_s = free_s;
    free_s += 0.4;
    if (free_s > 8.0) return std::nullopt;
  } while (!is_free(free_s));
  while (free_s - conflict_s > 1e-4) {
    const double middle_s = 0.5 * (free_s + conflict_s);
    (is_free(middle_s) ? free_s : conflict_s) = middle_s;
  }
  return delayed(free_s);
}

}  // namespace armloom::soundness
