#include "test/bench/pair_claims.h"

#include "test/bench/workloads.h"

namespace armloom::bench {

using namespace std::chrono_literals;

bool keeps_to_itself(Referees& referees, const Motions& motions) {
  if (!clear_of_all_but_arms(referees.exact, motions, 20ms, 0.04)) return false;
  Configuration q;
  for (Duration t{0}; t <= motions.trajectories.at(0)->duration(); t += 10ms) {
    motions.state_at(t, q);
    if (referees.moveit.in_collision(q)) return false;
  }
  return true;
}

bool is_clear_pair(Referees& referees, const Motions& pair) {
  return closest_in_band(referees.exact, pair, {100ms}, 0.2, 0.15) > 0.15 &&
         closest_in_band(referees.exact, pair, {10ms}, 0.2, 0.15) > 0.15 &&
         closest_in_band(referees.exact, pair, {50ms, 500ms}, 0.2, 0.10) > 0.10 &&
         keeps_to_itself(referees, pair);
}

bool is_crossing_pair(Referees& referees, const Motions& pair) {
  const double coarse_m = closest_in_band(referees.exact, pair, {100ms}, 0.2, 0.045);
  if (coarse_m < 0.045 || coarse_m > 0.08) return false;
  const double closest_m = closest_in_band(referees.exact, pair, {5ms}, 0.2, 0.045);
  return closest_m >= 0.045 && closest_m <= 0.055 &&
         closest_in_band(referees.exact, pair, {20ms, kCrossingBand}, 0.2, 0.04) >= 0.04 &&
         closest_in_band(referees.exact, pair, {200ms, 10s}, 0.2, 0.0) <= 0.0 &&
         keeps_to_itself(referees, pair);
}

bool are_clear_neighbours(Referees& referees, const Motions& motions, std::size_t i) {
  Motions two{motions.cell, {motions.trajectories[i], motions.trajectories[i + 1]}, motions.rest};
  return closest_in_band(referees.exact, two, {200ms}, 0.06, 0.05) > 0.05 &&
         closest_in_band(referees.exact, two, {100ms, 500ms}, 0.06, 0.05) > 0.05;
}

bool is_clear_hall(Referees& referees, const Motions& motions) {
  if (!keeps_to_itself(referees, motions)) return false;
  for (std::size_t i = 0; i + 1 < motions.trajectories.size(); ++i) {
    if (!are_clear_neighbours(referees, motions, i)) return false;
  }
  return true;
}

}  // namespace armloom::bench
