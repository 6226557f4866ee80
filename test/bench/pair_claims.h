#pragma once

#include "test/bench/motions.h"
#include "test/bench/states.h"

namespace armloom::bench {

// What the motions of the workloads claim, decided with exact shapes at samples. Shared by the
// search for them and by the check when they are made.

inline constexpr std::size_t kHallArms = 16;
inline constexpr double kHallSpacing_m = 1.2;  // next neighbours' reaches overlap, others' do not
inline constexpr double kPairReach = 0.5;
inline constexpr double kHallReach = 0.5;

// Each keeps 0.04 m from the table and 10 mm from itself, and the baseline calls the motions, run
// together, free.
[[nodiscard]] bool keeps_to_itself(Referees& referees, const Motions& motions);

// workloads.h says what each of them means.
[[nodiscard]] bool is_clear_pair(Referees& referees, const Motions& pair);
[[nodiscard]] bool is_crossing_pair(Referees& referees, const Motions& pair);
[[nodiscard]] bool is_clear_hall(Referees& referees, const Motions& motions);

// The part of is_clear_hall that concerns the arms i and i + 1.
[[nodiscard]] bool are_clear_neighbours(Referees& referees, const Motions& motions, std::size_t i);

}  // namespace armloom::bench
