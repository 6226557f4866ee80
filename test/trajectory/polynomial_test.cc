#include "core/trajectory/polynomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace armloom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double uniform(std::mt19937_64& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

Polynomial random_polynomial(std::mt19937_64& random) {
  Polynomial p{};
  for (double& c : p) c = uniform(random, -2.0, 2.0);
  return p;
}

TEST(Polynomial, CubicMatchesPositionAndVelocityAtBothEnds) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    const KnotState a{uniform(random, -3, 3), uniform(random, -2, 2)};
    const KnotState b{uniform(random, -3, 3), uniform(random, -2, 2)};
    const double T = std::pow(10.0, uniform(random, -2, 1));
    const Polynomial p = cubic(a, b, T);
    EXPECT_EQ(p[4], 0.0);
    EXPECT_EQ(p[5], 0.0);
    EXPECT_DOUBLE_EQ(evaluate(p, 0.0), a.position);
    EXPECT_DOUBLE_EQ(evaluate(derivative(p), 0.0), a.velocity);
    EXPECT_NEAR(evaluate(p, T), b.position, 1e-13);
    EXPECT_NEAR(evaluate(derivative(p), T), b.velocity, 1e-13 * std::max(1.0, 10.0 / T));
  }
}

TEST(Polynomial, QuinticMatchesAccelerationAtBothEnds) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 200; ++i) {
    const KnotState a{uniform(random, -3, 3), uniform(random, -2, 2), uniform(random, -5, 5)};
    const KnotState b{uniform(random, -3, 3), uniform(random, -2, 2), uniform(random, -5, 5)};
    const double T = std::pow(10.0, uniform(random, -2, 1));
    const Polynomial p = quintic(a, b, T);
    const Polynomial acceleration = derivative(derivative(p));
    EXPECT_DOUBLE_EQ(evaluate(acceleration, 0.0), a.acceleration);
    EXPECT_NEAR(evaluate(p, T), b.position, 1e-12 * std::max(1.0, T));
    EXPECT_NEAR(evaluate(derivative(p), T), b.velocity, 1e-12 * std::max(1.0, 1.0 / T));
    EXPECT_NEAR(evaluate(acceleration, T), b.acceleration, 1e-11 * std::max(1.0, 1.0 / (T * T)));
  }
}

TEST(Polynomial, BoundsEncloseEveryValueOnAnyInterval) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    const Polynomial p = random_polynomial(random);
    const double from = uniform(random, 0.0, 2.0);
    const double to = from + uniform(random, 0.0, 2.0);
    const Bounds b = bounds(p, from, to);
    for (int k = 0; k <= 1000; ++k) {
      const double value = evaluate(p, from + (to - from) * k / 1000.0);
      EXPECT_GE(value, b.lower);
      EXPECT_LE(value, b.upper);
    }
  }
}

TEST(Polynomial, BoundsTightenWithTheSquareOfTheInterval) {
  const Polynomial p = {1.0, -2.0, 0.5, 3.0, -1.0, 0.25};
  const auto slackness = [&](double h) {
    const Bounds b = bounds(p, 0.7, 0.7 + h);
    double lower = kInfinity;
    double upper = -kInfinity;
    for (int k = 0; k <= 2000; ++k) {
      const double value = evaluate(p, 0.7 + h * k / 2000.0);
      lower = std::min(lower, value);
      upper = std::max(upper, value);
    }
    return std::max(lower - b.lower, b.upper - upper);
  };
  EXPECT_LE(slackness(0.1), slackness(0.8) / 32.0 + 1e-9);
  EXPECT_NEAR(bounds(p, 0.7, 0.7).lower, evaluate(p, 0.7), 1e-12);
  EXPECT_NEAR(bounds(p, 0.7, 0.7).upper, evaluate(p, 0.7), 1e-12);
}

TEST(Polynomial, WorstOutsideReturnsTimeAndValue) {
  // 1 - (t - 0.3)^2: the maximum is inside, 1 at 0.3.
  const Polynomial hill = {0.91, 0.6, -1.0, 0.0, 0.0, 0.0};
  EXPECT_FALSE(worst_outside(hill, 1.0, {-kInfinity, 1.0}));
  const auto above = worst_outside(hill, 1.0, {-kInfinity, 0.95});
  ASSERT_TRUE(above);
  EXPECT_NEAR(above->t_s, 0.3, 1e-4);
  EXPECT_NEAR(above->value, 1.0, 2e-9);
  // The minimum is at the far end.
  const auto below = worst_outside(hill, 1.0, {0.8, kInfinity});
  ASSERT_TRUE(below);
  EXPECT_DOUBLE_EQ(below->t_s, 1.0);
  EXPECT_NEAR(below->value, 0.51, 1e-12);
  // Exceeds both limits: the larger excess counts.
  EXPECT_NEAR(worst_outside(hill, 1.0, {0.6, 0.9})->value, 1.0, 2e-9);
  EXPECT_NEAR(worst_outside(hill, 1.0, {0.7, 0.9})->value, 0.51, 1e-12);
}

TEST(Polynomial, AcceptsALimitThatIsTouchedExactly) {
  const Polynomial constant = {2.175, 0.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_FALSE(worst_outside(constant, 3.0, {-2.175, 2.175}));
  EXPECT_FALSE(worst_outside({2.1750000000000003, 0.0, 0.0, 0.0, 0.0, 0.0}, 3.0, {-2.175, 2.175}));
  EXPECT_TRUE(worst_outside(constant, 3.0, {-2.175, 2.17499}));
}

TEST(Polynomial, WorstOutsideAgreesWithDenseSamples) {
  std::mt19937_64 random(4);
  int broken = 0;
  for (int i = 0; i < 2000; ++i) {
    const Polynomial p = random_polynomial(random);
    const double T = uniform(random, 0.1, 2.0);
    const double limit = uniform(random, 0.5, 8.0);
    double worst = 0.0;
    for (int k = 0; k <= 2000; ++k) worst = std::max(worst, std::abs(evaluate(p, T * k / 2000.0)));
    const auto found = worst_outside(p, T, {-limit, limit});
    if (worst > limit * (1.0 + 1e-8)) {
      ASSERT_TRUE(found) << i;
    }
    if (!found) continue;
    ++broken;
    EXPECT_GT(std::abs(found->value), limit);
    EXPECT_NEAR(evaluate(p, found->t_s), found->value, 1e-9 * std::abs(found->value)) << i;
    EXPECT_GE(std::abs(found->value), worst - 1e-8 * worst) << i;
  }
  EXPECT_GT(broken, 400);
  EXPECT_LT(broken, 1600);
}

TEST(Polynomial, TerminatesOnHugeAndFlatPolynomials) {
  EXPECT_TRUE(worst_outside({-1e20, 4e20, -4e20, 0.0, 0.0, 0.0}, 1.0, {-1.0, 1.0}));
  EXPECT_FALSE(worst_outside({1.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.0, {-1.0, 1.0}));
  // (2t - 1)^4, negated and lifted, touches the limit with a flat maximum.
  EXPECT_FALSE(worst_outside({0.0, 8.0, -24.0, 32.0, -16.0, 0.0}, 1.0, {-1.0, 1.0}));
  EXPECT_TRUE(worst_outside({0.0, 8.0, -24.0, 32.0, -16.0, 0.0}, 1.0, {-1.0, 1.0 - 1e-6}));
}

TEST(Polynomial, MagnitudeDetectsOverflow) {
  EXPECT_FALSE(std::isfinite(magnitude(cubic({-1.7e308}, {1.7e308}, 1e-6), 1e-6)));
  EXPECT_FALSE(std::isfinite(magnitude(quintic({-1.7e308}, {1.7e308}, 1e-6), 1e-6)));
  EXPECT_DOUBLE_EQ(magnitude({-1.0, 2.0, -3.0, 0.0, 0.0, 0.0}, 2.0), 17.0);
}

}  // namespace
}  // namespace armloom
