#include <gtest/gtest.h>

#include <numbers>
#include <type_traits>

#include "core/base/disjoint_sets.h"
#include "core/base/ids.h"
#include "core/base/rounding_noise.h"
#include "core/base/time.h"
#include "core/base/whole_turns.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

TEST(CellTime, IsRoundedToTheNearestNanosecond) {
  EXPECT_EQ(from_seconds(0.1), 100ms);
  EXPECT_EQ(from_seconds(1.4e-9), 1ns);
  EXPECT_EQ(from_seconds(-1.6e-9), -2ns);
  EXPECT_EQ(to_seconds(at(1500ms)), 1.5);
  for (const Duration d : {1ns, 999'999'999ns, 3'600'000'000'001ns}) {
    EXPECT_EQ(from_seconds(to_seconds(d)), d) << d.count();
  }
}

TEST(StepId, ComparesByJobThenByIndex) {
  const StepId first{JobId{3}}, second{JobId{3}, 1}, of_next_job{JobId{4}};
  EXPECT_LT(first, second);
  EXPECT_LT(second, of_next_job);
  EXPECT_NE(std::hash<StepId>{}(first), std::hash<StepId>{}(second));
  static_assert(!std::is_convertible_v<JobId, StepId>);
}

TEST(DisjointSets, UseTheFirstMemberAsRoot) {
  DisjointSets sets;
  for (int i = 0; i < 6; ++i) sets.add();
  sets.join(5, 4);
  sets.join(1, 2);
  EXPECT_EQ(sets.root(5), 4U);
  EXPECT_EQ(sets.root(0), 0U);
  sets.join(5, 2);
  for (const std::size_t member : {1U, 2U, 4U, 5U}) EXPECT_EQ(sets.root(member), 1U);
  sets.join(4, 1);  // already joined
  EXPECT_EQ(sets.root(3), 3U);
}

TEST(Positions, DropRoundingNoise) {
  EXPECT_EQ(without_rounding_noise(6.9e-18), 0.0);
  EXPECT_FALSE(std::signbit(without_rounding_noise(-6.9e-18)));
  EXPECT_EQ(without_rounding_noise(-1e-6), -1e-6);
}

TEST(WholeTurns, AreReportedForEquivalentPositions) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  EXPECT_EQ(whole_turns_apart(1.0, 1.0 + kTurn_rad, 0.01),
            ", 1 whole turn away: positions are not taken modulo 2 pi");
  EXPECT_EQ(whole_turns_apart(-kTurn_rad, kTurn_rad + 0.005, 0.01),
            ", 2 whole turns away: positions are not taken modulo 2 pi");
  EXPECT_EQ(whole_turns_apart(1.0, 1.0 + kTurn_rad + 0.02, 0.01), "");
  EXPECT_EQ(whole_turns_apart(1.0, 1.001, 0.01), "") << "the same turn";
}

}  // namespace
}  // namespace armloom
