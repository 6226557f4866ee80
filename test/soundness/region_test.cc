#include "core/collision/region.h"

#include <gtest/gtest.h>

#include "core/base/time.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {
namespace {

// A region without any band is the plan's line: what lies on it must be found there in spite of
// seconds being rounded, else a conflict cell proves nothing.
TEST(Region, WithoutABandHoldsEveryStateOfItsPlan) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100'000; ++i) {
    const Duration progress_a = from_seconds(uniform(random, -3.0, 9.0));
    const Duration progress_b = from_seconds(uniform(random, -3.0, 9.0));
    const Region region{.progress_a = to_seconds(progress_a),
                        .progress_b = to_seconds(progress_b),
                        .duration_a = 10.0,
                        .duration_b = 10.0};
    const Duration t = from_seconds(uniform(random, 3.0, 13.0));
    const auto place = [&](Duration progress) {
      return to_seconds(std::clamp(progress + t, Duration{}, Duration{std::chrono::seconds(10)}));
    };
    const auto first = first_at(region, place(progress_a), place(progress_b));
    ASSERT_TRUE(first) << i;
    ASSERT_LE(*first, to_seconds(t) + 1e-8) << i;
  }
}

// A region is covered by the times of the cells that it meets: random states of it, however the
// motions are late, hurry to their stops, or stand, lie in some time range of their own cell.
TEST(Region, MeetsEveryCellThatHoldsOneOfItsStates) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 100'000; ++i) {
    const auto lag = [&] {
      const double kind = uniform(random, 0.0, 1.0);
      return kind < 0.3 ? 0.0 : kind < 0.8 ? uniform(random, 0.0, 0.5) : Region::kUnbounded;
    };
    const bool swept = random() % 8 == 0;
    const auto lead = [&] {
      return swept ? Region::kUnbounded : random() % 2 == 0 ? 0.0 : uniform(random, 0.0, 0.8);
    };
    const Region r{.progress_a = uniform(random, -3.0, 9.0),
                   .progress_b = uniform(random, -3.0, 9.0),
                   .lag_a = lag(),
                   .lag_b = lag(),
                   .lead_a = lead(),
                   .lead_b = lead(),
                   .duration_a = uniform(random, 9.0, 12.0),
                   .duration_b = uniform(random, 9.0, 12.0)};
    const double t = uniform(random, 0.0, 14.0);
    const auto state = [&](double progress, double behind, double ahead, double duration) {
      const double now = std::max(progress, 0.0);
      const double plan = std::clamp(progress + t, 0.0, duration);
      const double low = std::max(now, plan - std::min(behind, 100.0));
      const bool started = progress + t >= 0.0;  // before it, nothing lies ahead
      const double high = started ? std::min(duration, plan + std::min(ahead, 100.0)) : now;
      return uniform(random, low, high);
    };
    const double a = state(r.progress_a, r.lag_a, r.lead_a, r.duration_a);
    const double b = state(r.progress_b, r.lag_b, r.lead_b, r.duration_b);
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

// Where times do not count, whatever is left of both motions counts, though one has yet to wait.
TEST(Region, ThatIsSweptHoldsTheWholeRectangleOfWhatRemains) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 100'000; ++i) {
    const double all = Region::kUnbounded;
    const Region r{.progress_a = uniform(random, -3.0, 9.0),
                   .progress_b = uniform(random, -3.0, 9.0),
                   .lag_a = all,
                   .lag_b = all,
                   .lead_a = all,
                   .lead_b = all,
                   .duration_a = uniform(random, 9.0, 12.0),
                   .duration_b = uniform(random, 9.0, 12.0)};
    const double a = uniform(random, std::max(0.0, r.progress_a), r.duration_a);
    const double b = uniform(random, std::max(0.0, r.progress_b), r.duration_b);
    ASSERT_TRUE(meets(r, a, a + 1e-6, b, b + 1e-6)) << i;
    ASSERT_TRUE(first_at(r, a, b)) << i;
  }
}

// The plan is extrapolated from a measurement: an arm that stalls just then is behind the plan, and
// may be as far back as was measured, but within its lag.
TEST(Region, ReachesBackToWhatIsProven) {
  Region region{.progress_a = 1.0, .lag_a = 0.1, .duration_a = 10.0};
  const auto holds = [&](double a) { return first_at(region, a, 0.0).has_value(); };
  EXPECT_FALSE(holds(0.95));
  region.proven_a = 0.93;
  EXPECT_TRUE(holds(0.95));
  EXPECT_FALSE(holds(0.92));
  region.proven_a = 0.5;
  EXPECT_TRUE(holds(0.91));
  EXPECT_FALSE(holds(0.89));
}

}  // namespace
}  // namespace armloom::soundness
