#pragma once

#include <limits>
#include <optional>

#include "core/base/time.h"

namespace armloom {

// Which places of a coordination diagram (progress of A, progress of B) a question is about: as
// time t >= 0 goes on, both advance second by second from where they are to their ends and rest
// there (a negative progress: rests at the start for that long); around the point (a(t), b(t)) lies
// the rectangle [a - lag_a, a + lead_a] x [b - lag_b, b + lead_b], never behind where they are now
// nor outside of the motions. Seconds of trajectory time.
struct Region {
  inline static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  double progress_a = 0.0;
  double progress_b = 0.0;
  double lag_a = 0.0;  // unbounded: may stand where it is, or be anywhere behind its plan
  double lag_b = 0.0;
  double lead_a = 0.0;  // unbounded (both): the whole rectangle of what remains of the two motions
  double lead_b = 0.0;
  double duration_a = 0.0;
  double duration_b = 0.0;
  // What measurement has proven, where `progress` is extrapolated from it: the lag reaches back to
  // there. Unbounded: progress itself.
  double proven_a = kUnbounded;
  double proven_b = kUnbounded;
};

// Times at which the region covers a part of a cell.
struct TimeRange {
  double from;
  double to;  // may be infinite
};

// When the region meets the cell [a1, a2] x [b1, b2] in more than a point of time; nothing: never.
[[nodiscard]] std::optional<TimeRange> meets(const Region& region, double a1, double a2, double b1,
                                             double b2);
// When the region first holds the point; nothing: never.
[[nodiscard]] std::optional<double> first_at(const Region& region, double a, double b);

}  // namespace armloom
