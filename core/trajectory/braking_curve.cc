#include "core/trajectory/braking_curve.h"

#include <algorithm>
#include <cmath>

namespace armloom {
namespace {

constexpr Duration kStep = std::chrono::milliseconds(1);
constexpr double kStep_s = 1e-3;
// Share of the brake limits that the curve uses. Below one, so that an arm between two points of
// the curve can stay below the curve without exceeding the brake limits.
constexpr double kLimitShare = 0.95;

}  // namespace

void BrakingCurve::compute(RateLaw& law, Duration from, Duration authority) {
  authority_ = authority;
  authority_s_ = to_seconds(authority);
  squares_.assign(1, 0.0);
  Duration place = authority;
  double square = 0.0;
  double deceleration = RateLaw::kRateChangeMax_1_s;
  while (place > from && square < 1.0) {
    const Duration before = std::max(place - kStep, Duration{});
    const double expected = std::min(1.0, square + 2.0 * deceleration * kStep_s);
    deceleration =
        -law.brake({before, std::sqrt(expected)}, {place, std::sqrt(square)}, kLimitShare);
    square = std::min(1.0, square + 2.0 * deceleration * kStep_s);
    squares_.push_back(square);
    place -= kStep;
  }
  free_until_ = square < 1.0 ? std::min(place, from) : place;
}

double BrakingCurve::rate_squared(double progress_s) const {
  const double back = (authority_s_ - progress_s) / kStep_s;
  if (back <= 0.0) return 0.0;
  const auto k = static_cast<std::size_t>(back);
  if (k + 1 >= squares_.size()) return squares_.back();
  const double part = back - static_cast<double>(k);
  return squares_[k] + part * (squares_[k + 1] - squares_[k]);
}

}  // namespace armloom
