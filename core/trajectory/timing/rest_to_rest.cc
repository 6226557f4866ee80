#include "core/trajectory/timing/rest_to_rest.h"

#include <algorithm>
#include <cmath>

namespace armloom {
namespace {

// Durations (s) of the phases of the first half: the acceleration grows (`grow`), is constant
// (`hold`), and falls for as long as it grew. Then the velocity is constant (`cruise`).
struct Phases {
  double grow;
  double hold;
  double cruise;
};

// Returns the phases of the fastest motion over the distance 1.
Phases fastest(const ProfileRates& r) {
  // If the velocity limit is reached, with or without the acceleration limit:
  Phases p{};
  if (r.velocity * r.jerk >= r.acceleration * r.acceleration) {
    p.grow = r.acceleration / r.jerk;
    p.hold = r.velocity / r.acceleration - p.grow;
  } else {
    p.grow = std::sqrt(r.velocity / r.jerk);
  }
  p.cruise = 1.0 / r.velocity - (2.0 * p.grow + p.hold);
  if (p.cruise >= 0.0) return p;
  // Otherwise, without cruise: a (grow + hold) (2 grow + hold) = 1.
  p = {r.acceleration / r.jerk, 0.0, 0.0};
  const double rising = 0.5 * p.grow + std::sqrt(0.25 * p.grow * p.grow + 1.0 / r.acceleration);
  p.hold = rising - 2.0 * p.grow;
  if (p.hold < 0.0) p = {std::cbrt(0.5 / r.jerk), 0.0, 0.0};
  return p;
}

Duration up(double seconds) {
  return Duration{static_cast<Duration::rep>(std::ceil(seconds * 1e9))};
}

}  // namespace

std::vector<ProfileKnot> rest_to_rest(const ProfileRates& rates) {
  const Phases least = fastest(rates);
  const Duration grow = std::max(up(least.grow), kJerkPhaseMin);
  const Duration hold = up(least.hold);
  const Duration cruise = up(least.cruise);
  // All times are rounded up, so these do not exceed the rates.
  const double grow_s = to_seconds(grow);
  const double peak = 1.0 / to_seconds(2 * grow + hold + cruise);  // velocity
  const double top = peak / to_seconds(grow + hold);               // acceleration
  const double jerk = top / grow_s;

  std::vector<ProfileKnot> knots{{Duration{}, 0.0, 0.0, 0.0}};
  const auto add = [&](Duration duration, double velocity, double acceleration, double by_jerk) {
    if (duration == Duration{}) return;
    const ProfileKnot& from = knots.back();
    const double t = to_seconds(duration);
    const double s =
        from.s + t * (from.velocity + t * (from.acceleration / 2.0 + t * by_jerk / 6.0));
    knots.push_back({from.time + duration, s, velocity, acceleration});
  };
  const double first = 0.5 * top * grow_s;  // velocity at the end of the first phase
  add(grow, first, top, jerk);
  add(hold, peak - first, top, 0.0);
  add(grow, peak, 0.0, -jerk);
  add(cruise, peak, 0.0, 0.0);
  add(grow, peak - first, -top, -jerk);
  add(hold, first, -top, 0.0);
  add(grow, 0.0, 0.0, jerk);
  knots.back().s = 1.0;
  return knots;
}

}  // namespace armloom
