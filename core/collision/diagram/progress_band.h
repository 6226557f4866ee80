#pragma once

#include <limits>
#include <optional>

namespace armloom {

// The states (progress of A, progress of B) that a question covers. From t = 0 on, both motions
// advance by one second per second to their ends, and rest there. Each motion may be up to its lag
// behind its planned progress at time t, but never behind its present progress. All in seconds of
// trajectory time; 0 <= progress <= duration.
struct ProgressBand {
  inline static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  double progress_a = 0.0;
  double progress_b = 0.0;
  double lag_a = 0.0;
  double lag_b = 0.0;
  double duration_a = 0.0;
  double duration_b = 0.0;
  bool swept = false;  // covers every combination of what remains of A and of B
};

// Times t at which the band covers part of a cell.
struct TimeRange {
  double from;
  double to;  // may be infinite
};

// Returns the times at which the band meets the cell [a1, a2] x [b1, b2]. nullopt if it meets the
// cell for at most an instant.
[[nodiscard]] std::optional<TimeRange> meets(const ProgressBand& band, double a1, double a2,
                                             double b1, double b2);
// Returns the time at which the band first contains the state (a, b), or nullopt if never.
[[nodiscard]] std::optional<double> first_at(const ProgressBand& band, double a, double b);

}  // namespace armloom
