#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "test/soundness/truth.h"

namespace armloom::soundness {

// Returns the motions' conflict with each other, or nullptr; other conflicts are ignored.
[[nodiscard]] const Conflict* between_motions(const Verdict& verdict);

// Returns the time (s) after the question's time at which the planned motions enter a region of a
// Coordinated verdict; nullopt if never.
[[nodiscard]] std::optional<double> first_in_regions_s(const Verdict& regions,
                                                       const MovingPair& pair);

// Collisions that the discrete check misses, of pairs that truly collide (distance <= 0).
struct DiscreteRow {
  double step_s;
  // With the cell's clearance, and with none as in the paper.
  struct Missed {
    std::size_t pairs = 0;
    double deepest_m = 0.0;  // smallest true distance among them
    double longest_s = 0.0;  // longest time in contact
  } with_clearance, without;
};

// Compares the certified regions of all pairs with exact distances. Motions run as planned.
struct Report {
  std::size_t pairs = 0;
  std::size_t colliding = 0;  // true smallest distance <= 0
  std::size_t below = 0;      // below the cell's clearance, including colliding pairs
  std::size_t close = 0;      // from the clearance to 0.10 m
  std::size_t above = 0;      // above clearance + kLoose_m
  std::size_t missed = 0;     // pairs of `below` that meet no region: must be 0
  std::size_t missed_collisions = 0;
  std::size_t false_alarms = 0;            // pairs of `above` that meet a region
  double first_conflict_late_max_s = 0.0;  // delay of the region after the true conflict
  std::uint64_t evaluations_max = 0;
  std::uint64_t evaluations_total = 0;
  std::size_t truth_samples = 0;  // computed samples
  std::vector<DiscreteRow> discrete;
  std::vector<std::string> failures;  // single pairs, with their numbers

  [[nodiscard]] double false_alarm_share() const {
    return above == 0 ? 0.0 : static_cast<double>(false_alarms) / static_cast<double>(above);
  }
};
inline constexpr double kLoose_m = 0.05;

// Measures pairs of two Pandas, with discrete checks at these steps. If `holding`, each hand holds
// a box.
[[nodiscard]] Report measure(std::size_t count, std::uint64_t seed,
                             const std::vector<double>& steps_s, bool holding = false);
void print_markdown(const Report& report, std::ostream& out);

}  // namespace armloom::soundness
