#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "test/soundness/truth.h"

namespace armloom::soundness {

// The conflict of the two motions with each other; null: they are called free of each other. What
// a verdict says of rests, scene and an arm's own links is not looked at.
[[nodiscard]] const Conflict* between_motions(const Verdict& verdict);

// When after the question's instant the two motions, each going on as planned, first come to a
// state that the regions of a Coordinated verdict hold (seconds); nothing: never.
[[nodiscard]] std::optional<double> first_in_regions_s(const Verdict& regions,
                                                       const MovingPair& pair);

// What the discrete check with one step makes of the pairs that truly collide (distance <= 0).
struct DiscreteRow {
  double step_s;
  // With the cell's clearance, and with none: as the paper has it.
  struct Missed {
    std::size_t pairs = 0;
    double deepest_m = 0.0;  // of their true distances, the smallest
    double longest_s = 0.0;  // for how long the worst of them is in contact
  } with_clearance, without;
};

// What certified regions make of all pairs, whose motions go on as planned.
struct Report {
  std::size_t pairs = 0;
  std::size_t colliding = 0;  // true smallest distance <= 0
  std::size_t below = 0;      // below the cell's clearance (the colliding ones among them)
  std::size_t close = 0;      // from there to 0.10 m
  std::size_t above = 0;      // above clearance + kLoose_m
  std::size_t missed = 0;     // of `below`, that meet no region: must be none
  std::size_t missed_collisions = 0;
  std::size_t false_alarms = 0;            // of `above`, that meet a region
  double first_conflict_late_max_s = 0.0;  // the region behind the truth
  std::uint64_t evaluations_max = 0;
  std::uint64_t evaluations_total = 0;
  std::size_t truth_samples = 0;  // looked at
  std::vector<DiscreteRow> discrete;
  std::vector<std::string> failures;  // of single pairs, with their numbers

  [[nodiscard]] double false_alarm_share() const {
    return above == 0 ? 0.0 : static_cast<double>(false_alarms) / static_cast<double>(above);
  }
};
inline constexpr double kLoose_m = 0.05;

// All of it for `count` pairs of two Pandas. Discrete checks for the steps named.
[[nodiscard]] Report measure(std::size_t count, std::uint64_t seed,
                             const std::vector<double>& steps_s);
void print_markdown(const Report& report, std::ostream& out);

}  // namespace armloom::soundness
