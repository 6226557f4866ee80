#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace armloom {

// Cell time starts at zero when the executive starts. With --speed X it runs X times faster than
// the wall clock. There is no now(), because only the executive's drivers read a clock.
struct CellClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<CellClock, duration>;
  static constexpr bool is_steady = true;
};

using Duration = CellClock::duration;
using TimePoint = CellClock::time_point;

// Returns the instant `since_start` after the executive started.
[[nodiscard]] constexpr TimePoint at(Duration since_start) { return TimePoint{since_start}; }

[[nodiscard]] constexpr double to_seconds(Duration d) {
  return static_cast<double>(d.count()) / 1e9;
}
[[nodiscard]] constexpr double to_seconds(TimePoint t) { return to_seconds(t.time_since_epoch()); }

// Rounds to the nearest nanosecond. Precondition: finite, |seconds| < 9e9.
[[nodiscard]] inline Duration from_seconds(double seconds) {
  return Duration{std::llround(seconds * 1e9)};
}

}  // namespace armloom
