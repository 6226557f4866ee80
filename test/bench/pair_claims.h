#pragma once

#include "test/bench/motions.h"
#include "test/bench/states.h"

namespace armloom::bench {

// Claims about the workloads' motions, decided with exact shapes at samples.

inline constexpr std::size_t kHallArms = 16;
inline constexpr double kHallSpacing_m = 1.2;  // only adjacent arms have overlapping reaches
inline constexpr double kPairReach = 0.5;
inline constexpr double kHallReach = 0.5;

// Returns true if each motion keeps 0.04 m from the table and 10 mm from itself, and the baseline
// reports no collision.
[[nodiscard]] bool keeps_to_itself(Referees& referees, const Motions& motions);

// See workloads.h.
[[nodiscard]] bool is_clear_pair(Referees& referees, const Motions& pair);
[[nodiscard]] bool is_crossing_pair(Referees& referees, const Motions& pair);
[[nodiscard]] bool is_clear_hall(Referees& referees, const Motions& motions);

// Checks what is_clear_hall() checks, but for the arms i and i + 1 only.
[[nodiscard]] bool are_clear_neighbours(Referees& referees, const Motions& motions, std::size_t i);

}  // namespace armloom::bench
