#include "core/monitor/stop_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>

namespace armloom {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

StopConflict pair(std::uint32_t a, std::uint32_t b, bool a_suffices = true,
                  bool b_suffices = true) {
  return {ArmId{a}, ArmId{b}, a_suffices, b_suffices};
}

TEST(StopSet, IsEmptyWithoutConflicts) { EXPECT_THAT(smallest_stop_set({}), IsEmpty()); }

TEST(StopSet, StopsTheArmThatResolvesMostConflicts) {
  EXPECT_THAT(smallest_stop_set({pair(0, 1)}), ElementsAre(ArmId{0})) << "the smaller id";
  EXPECT_THAT(smallest_stop_set({pair(0, 3), pair(1, 3), pair(2, 3)}), ElementsAre(ArmId{3}));
  EXPECT_THAT(smallest_stop_set({pair(0, 1), pair(1, 2), pair(2, 3)}),
              ElementsAre(ArmId{0}, ArmId{2}));
}

TEST(StopSet, StopsBothArmsIfNeitherSuffices) {
  EXPECT_THAT(smallest_stop_set({pair(0, 1, false, false)}), ElementsAre(ArmId{0}, ArmId{1}));
  EXPECT_THAT(smallest_stop_set({pair(0, 1, false, true)}), ElementsAre(ArmId{1}));
}

TEST(StopSet, StopsAnArmThatApproachesTheScene) {
  EXPECT_THAT(smallest_stop_set({{.a = ArmId{2}}, pair(1, 2)}), ElementsAre(ArmId{2}));
}

TEST(StopSet, JoinsGroupsWithoutACommonArm) {
  EXPECT_THAT(smallest_stop_set({pair(4, 5), pair(0, 1)}), ElementsAre(ArmId{0}, ArmId{4}));
}

bool resolves(const std::vector<StopConflict>& conflicts, std::uint32_t stops) {
  const auto has = [&](ArmId arm) { return (stops >> arm.value() & 1U) != 0; };
  return std::ranges::all_of(conflicts, [&](const StopConflict& one) {
    return one.is_resolved_by(has(one.a), one.b && has(*one.b));
  });
}

std::vector<StopConflict> random_conflicts(std::uint32_t arms, std::size_t count,
                                           std::mt19937& random) {
  std::vector<StopConflict> conflicts;
  while (conflicts.size() < count) {
    const auto any = [&] { return static_cast<std::uint32_t>(random() % arms); };
    const std::uint32_t a = any(), b = any();
    if (a == b) {
      conflicts.push_back({.a = ArmId{a}});
    } else {
      conflicts.push_back(pair(a, b, random() % 4 != 0, random() % 4 != 0));
    }
  }
  return conflicts;
}

TEST(StopSet, IsTheSmallestForUpToTwelveArms) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    const auto arms = static_cast<std::uint32_t>(2 + random() % 8);
    const auto conflicts = random_conflicts(arms, 1 + random() % 12, random);
    std::uint32_t stops = 0;
    for (const ArmId arm : smallest_stop_set(conflicts)) stops |= 1U << arm.value();
    ASSERT_TRUE(resolves(conflicts, stops)) << i;
    for (std::uint32_t other = 0; other < (1U << arms); ++other) {
      if (std::popcount(other) >= std::popcount(stops)) continue;
      ASSERT_FALSE(resolves(conflicts, other)) << i;
    }
  }
}

TEST(StopSet, ResolvesAllConflictsOfManyArms) {
  std::mt19937 random(8);
  for (int i = 0; i < 50; ++i) {
    const auto conflicts = random_conflicts(20, 30, random);
    std::uint32_t stops = 0;
    for (const ArmId arm : smallest_stop_set(conflicts)) stops |= 1U << arm.value();
    ASSERT_TRUE(resolves(conflicts, stops)) << i;
  }
}

}  // namespace
}  // namespace armloom
