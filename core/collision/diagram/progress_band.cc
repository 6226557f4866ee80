#include "core/collision/diagram/progress_band.h"

#include <algorithm>

namespace armloom {
namespace {

// Instants closer than this are treated as equal, because progress is in whole nanoseconds and
// seconds are rounded.
constexpr double kInstant_s = 1e-9;

// Returns the times t at which [x1, x2] meets [p(t) - lag, p(t)], where p(t) is the planned
// progress.
std::optional<TimeRange> times(double x1, double x2, double progress, double lag, double duration) {
  if (x2 < progress) return std::nullopt;
  return TimeRange{x1 > progress ? x1 - progress : 0.0,
                   x2 < duration - lag ? x2 + lag - progress : ProgressBand::kUnbounded};
}

// Returns the times at which the band meets [a1, a2] x [b1, b2]. Because of rounding, the range may
// end before it begins.
std::optional<TimeRange> both(const ProgressBand& r, double a1, double a2, double b1, double b2) {
  const auto a = times(a1, a2, r.progress_a, r.lag_a, r.duration_a);
  const auto b = times(b1, b2, r.progress_b, r.lag_b, r.duration_b);
  if (!a || !b) return std::nullopt;
  if (r.swept) return TimeRange{0.0, ProgressBand::kUnbounded};
  const TimeRange range{std::max(a->from, b->from), std::min(a->to, b->to)};
  return range.from <= range.to + 2.0 * kInstant_s ? std::optional(range) : std::nullopt;
}

}  // namespace

std::optional<TimeRange> meets(const ProgressBand& band, double a1, double a2, double b1,
                               double b2) {
  // If the band meets the cell only for an instant, at a corner, the next cell also contains this
  // state.
  const auto range = both(band, a1, a2, b1, b2);
  return range && range->to - range->from > kInstant_s ? range : std::nullopt;
}

std::optional<double> first_at(const ProgressBand& band, double a, double b) {
  const auto range = both(band, a, a, b, b);
  return range ? std::optional(range->from) : std::nullopt;
}

}  // namespace armloom
