#include "core/collision/diagram/progress_band.h"

#include <gtest/gtest.h>

#include "core/base/time.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {
namespace {

// A band without width is the line of planned states. It must contain these states despite the
// rounding of seconds.
TEST(ProgressBand, WithoutWidthContainsEveryPlannedState) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100'000; ++i) {
    const Duration progress_a = from_seconds(uniform(random, 0.0, 9.0));
    const Duration progress_b = from_seconds(uniform(random, 0.0, 9.0));
    const ProgressBand region{.progress_a = to_seconds(progress_a),
                              .progress_b = to_seconds(progress_b),
                              .duration_a = 10.0,
                              .duration_b = 10.0};
    const Duration t = from_seconds(uniform(random, 0.0, 13.0));
    const auto place = [&](Duration progress) {
      return to_seconds(std::clamp(progress + t, Duration{}, Duration{std::chrono::seconds(10)}));
    };
    const auto first = first_at(region, place(progress_a), place(progress_b));
    ASSERT_TRUE(first) << i;
    ASSERT_LE(*first, to_seconds(t) + 1e-8) << i;
  }
}

// For a random state of a band, with any lag, the cell around it must be met at the state's time.
TEST(ProgressBand, MeetsEveryCellWithOneOfItsStates) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 100'000; ++i) {
    const auto lag = [&] { return random() % 3 == 0 ? 0.0 : uniform(random, 0.0, 0.8); };
    const ProgressBand r{.progress_a = uniform(random, 0.0, 9.0),
                         .progress_b = uniform(random, 0.0, 9.0),
                         .lag_a = lag(),
                         .lag_b = lag(),
                         .duration_a = uniform(random, 9.0, 12.0),
                         .duration_b = uniform(random, 9.0, 12.0),
                         .swept = random() % 8 == 0};
    const double t = uniform(random, 0.0, 14.0);
    const auto state = [&](double progress, double behind, double duration) {
      const double plan = std::min(progress + t, duration);
      return uniform(random, std::max(progress, plan - behind), plan);
    };
    const double a = state(r.progress_a, r.lag_a, r.duration_a);
    const double b = state(r.progress_b, r.lag_b, r.duration_b);
    const double half = uniform(random, 1e-6, 0.4);
    const double a1 = std::max(0.0, a - half), a2 = std::min(r.duration_a, a + half);
    const double b1 = std::max(0.0, b - half), b2 = std::min(r.duration_b, b + half);
    const auto times = meets(r, a1, a2, b1, b2);
    ASSERT_TRUE(times) << i;
    ASSERT_LE(times->from, t + 1e-9) << i;
    ASSERT_GE(times->to, t - 1e-9) << i;
    const auto first = first_at(r, a, b);
    ASSERT_TRUE(first) << i;
    ASSERT_LE(*first, t + 1e-8) << i;
  }
}

TEST(ProgressBand, SweptBandContainsTheRemainingRectangle) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 100'000; ++i) {
    const ProgressBand r{.progress_a = uniform(random, 0.0, 9.0),
                         .progress_b = uniform(random, 0.0, 9.0),
                         .duration_a = uniform(random, 9.0, 12.0),
                         .duration_b = uniform(random, 9.0, 12.0),
                         .swept = true};
    const double a = uniform(random, r.progress_a, r.duration_a);
    const double b = uniform(random, r.progress_b, r.duration_b);
    ASSERT_TRUE(meets(r, a, a + 1e-6, b, b + 1e-6)) << i;
    ASSERT_TRUE(first_at(r, a, b)) << i;
  }
}

}  // namespace
}  // namespace armloom::soundness
