#include "core/collision/region.h"

#include <algorithm>

namespace armloom {
namespace {

// One motion's share of a region.
struct Axis {
  double progress, lag, lead, duration, proven;

  // When [x1, x2] meets [max(proven, p(t) - lag), p(t) + lead], p(t) being where it is planned.
  [[nodiscard]] std::optional<TimeRange> times(double x1, double x2) const {
    const double now = std::clamp(progress, 0.0, duration);
    if (x2 < std::min(now, std::max(proven, 0.0))) return std::nullopt;
    TimeRange range{0.0, Region::kUnbounded};
    const double starts = std::max(0.0, -progress);  // before it, nothing lies ahead
    if (x1 > now) range.from = std::max(starts, x1 - lead - progress);
    if (x2 < duration - lag) range.to = x2 + lag - progress;
    return range;
  }
};

// Instants closer than this are one: progress is in whole nanoseconds, and seconds are rounded.
constexpr double kInstant_s = 1e-9;

// A range may end before it begins by no more than that rounding.
std::optional<TimeRange> both(const Region& r, double a1, double a2, double b1, double b2) {
  const auto a = Axis{r.progress_a, r.lag_a, r.lead_a, r.duration_a, r.proven_a}.times(a1, a2);
  const auto b = Axis{r.progress_b, r.lag_b, r.lead_b, r.duration_b, r.proven_b}.times(b1, b2);
  if (!a || !b) return std::nullopt;
  const TimeRange range{std::max(a->from, b->from), std::min(a->to, b->to)};
  return range.from <= range.to + 2.0 * kInstant_s ? std::optional(range) : std::nullopt;
}

}  // namespace

std::optional<TimeRange> meets(const Region& region, double a1, double a2, double b1, double b2) {
  // A single instant at a corner belongs to the next cell too.
  const auto range = both(region, a1, a2, b1, b2);
  return range && range->to - range->from > kInstant_s ? range : std::nullopt;
}

std::optional<double> first_at(const Region& region, double a, double b) {
  const auto range = both(region, a, a, b, b);
  return range ? std::optional(range->from) : std::nullopt;
}

}  // namespace armloom
