#include "test/soundness/band.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/trajectory/stopping_reach.h"
#include "test/soundness/soundness.h"

namespace armloom::soundness {
namespace {

constexpr double kAnywhere_s = 1e6;  // of any motion here
constexpr int kThrows = 60;
constexpr int kSteps = 160;

// A state in the unit cube: time, place of each motion in its band, and each joint's deviation.
struct Point {
  double t = 0.0;
  double candidate = 0.0;
  double other = 0.0;
  std::vector<double> deviation;  // -1 to 1, by joint of the cell
};

class Attacker {
 public:
  Attacker(bench::ExactScene& exact, const MovingPair& pair, const Promise& promise)
      : exact_(exact), pair_(pair), promise_(promise), q_(exact.cell().home()) {}

  Attack look(const Point& point, double horizon_m) {
    const double t_s = point.t * pair_.span_s();
    const double candidate_s = place(pair_.candidate, t_s, promise_.lag_candidate_s,
                                     promise_.lead_candidate_s, point.candidate);
    const double other_s =
        place(pair_.other, t_s, promise_.lag_other_s, promise_.lead_other_s, point.other);
    q_ = exact_.cell().home();
    pair_.state_at(t_s, candidate_s, other_s, q_);
    for (std::size_t j = 0; j < point.deviation.size(); ++j) {
      q_[static_cast<Eigen::Index>(j)] += promise_.tracking_error * point.deviation[j];
    }
    return {exact_.between_arms(q_, horizon_m), t_s, candidate_s, other_s, q_};
  }

 private:
  // How far ahead of its plan: from the last place that it may still be at to the first that it
  // may already be at.
  static double place(const Motion& motion, double t_s, double lag_s, double lead_s, double share) {
    const double end = to_seconds(motion.trajectory->duration());
    const double now = std::clamp(to_seconds(motion.progress), 0.0, end);
    const double plan = std::clamp(to_seconds(motion.progress) + t_s, 0.0, end);
    const double low = std::max(now, plan - lag_s);
    const double high = std::min(end, plan + lead_s);
    return low + share * (high - low) - (to_seconds(motion.progress) + t_s);
  }

  bench::ExactScene& exact_;
  const MovingPair& pair_;
  const Promise& promise_;
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

Promise promise_of(const Cell& cell, const MovingPair& pair, const CheckMethod& method) {
  Promise promise;
  if (const auto* swept = std::get_if<Swept>(&method)) {
    return {kAnywhere_s, kAnywhere_s, kAnywhere_s, kAnywhere_s, swept->tracking_error};
  }
  const auto& certified = std::get<Certified>(method);
  promise.tracking_error = certified.tracking_error;
  const double lag_s = to_seconds(certified.lag);
  promise.lag_candidate_s = pair.candidate.may_stand ? kAnywhere_s : lag_s;
  promise.lag_other_s = pair.other.may_stand ? kAnywhere_s : lag_s;
  if (!certified.stopping) return promise;
  const double reaction_s = to_seconds(cell.monitor.reaction);
  promise.lead_candidate_s = reaction_s + stopping_reach_s(cell, *pair.candidate.trajectory);
  promise.lead_other_s = reaction_s + stopping_reach_s(cell, *pair.other.trajectory);
  return promise;
}

Attack attack(bench::ExactScene& exact, const MovingPair& pair, const Promise& promise,
              double horizon_m, std::mt19937_64& random) {
  Attacker attacker(exact, pair, promise);
  const std::size_t joints = exact.cell().joints.size();
  Attack best{horizon_m, 0.0, 0.0, 0.0, {}};
  Point at{0.0, 0.0, 0.0, std::vector<double>(joints, 0.0)};
  const auto keep = [&](const Point& point) {
    const Attack seen = attacker.look(point, best.distance_m);
    if (seen.distance_m >= best.distance_m) return;
    best = seen;
    at = point;
  };
  for (int i = 0; i < kThrows; ++i) {
    Point point{(i + uniform(random, 0.0, 1.0)) / kThrows, extreme_or_any(random, 0.0, 1.0),
                extreme_or_any(random, 0.0, 1.0), std::vector<double>(joints)};
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
      move(point.t, 0.0, 0.02);
      move(point.candidate, 0.0, 0.5);
      move(point.other, 0.0, 0.5);
    }
    if (i % 3 != 0) {
      const std::size_t j = random() % joints;
      point.deviation[j] = point.deviation[j] > 0.0 ? -1.0 : 1.0;
    }
    keep(point);
  }
  return best;
}

std::optional<MovingPair> hardly_free(Arbiter& arbiter, bench::ExactScene& exact,
                                      const MovingPair& pair, const CheckMethod& method) {
  const Cell& cell = exact.cell();
  const auto delayed = [&](double delay_s) {
    MovingPair later = pair;
    later.candidate.progress = pair.candidate.progress - from_seconds(delay_s);
    return later;
  };
  const auto is_free = [&](double delay_s) {
    const Verdict verdict = arbiter.judge(delayed(delay_s).question(cell, method));
    return between_motions(verdict) == nullptr;
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
