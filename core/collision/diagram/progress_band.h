#pragma once

#include <limits>
#include <optional>

namespace armloom {

// Which places of a coordination diagram (progress of A, progress of B) a question is about: as
// time t >= 0 goes on, both advance second by second from where they are to their ends and rest
// there; each may be up to its lag behind its point (a(t), b(t)), but never behind where it is now.
// Seconds of trajectory time; 0 <= progress <= duration.
struct ProgressBand {
  inline static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  double progress_a = 0.0;
  double progress_b = 0.0;
  double lag_a = 0.0;
  double lag_b = 0.0;
  double duration_a = 0.0;
  double duration_b = 0.0;
  bool swept = false;  // whatever the times: the whole rectangle of what remains of the two motions
};

// Times at which the band covers a part of a cell.
struct TimeRange {
  double from;
  double to;  // may be infinite
};

// When the band meets the cell [a1, a2] x [b1, b2] in more than a point of time; nothing: never.
[[nodiscard]] std::optional<TimeRange> meets(const ProgressBand& band, double a1, double a2,
                                             double b1, double b2);
// When the band first holds the point; nothing: never.
[[nodiscard]] std::optional<double> first_at(const ProgressBand& band, double a, double b);

}  // namespace armloom
