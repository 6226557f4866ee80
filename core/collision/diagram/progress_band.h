#pragma once

#include <limits>
#include <optional>

namespace armloom {

// The states (progress of A, progress of B) that a question is about. As time t >= 0 passes, both
// advance second by second to their ends and rest there. Each may be up to its lag behind its
// planned point (a(t), b(t)), but never behind its present progress. Seconds of trajectory time; 0
// <= progress <= duration.
struct ProgressBand {
  inline static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  double progress_a = 0.0;
  double progress_b = 0.0;
  double lag_a = 0.0;
  double lag_b = 0.0;
  double duration_a = 0.0;
  double duration_b = 0.0;
  bool swept = false;  // at all times: the rectangle of all that remains
};

// Times at which the band covers part of a cell.
struct TimeRange {
  double from;
  double to;  // may be infinite
};

// Returns when the band meets the cell [a1, a2] x [b1, b2] for more than an instant, or nullopt.
[[nodiscard]] std::optional<TimeRange> meets(const ProgressBand& band, double a1, double a2,
                                             double b1, double b2);
// Returns when the band first contains the point, or nullopt.
[[nodiscard]] std::optional<double> first_at(const ProgressBand& band, double a, double b);

}  // namespace armloom
