#include "core/scheduler/safe_state.h"

#include <gtest/gtest.h>

namespace armloom {
namespace {

constexpr JobId kA1{1}, kA2{2}, kB1{3}, kB2{4};
constexpr ArmId kA{0}, kB{1};

using Jobs = std::vector<JobId>;

// A and B have a job each.
const std::vector<WaitingWork> kTwo{{kA1, {kA}}, {kB1, {kB}}};

TEST(SafeState, AnyOrderDoesWhereNobodyRestsInTheWay) {
  EXPECT_EQ(order_of_work(kTwo, {}, {}), (Jobs{kA1, kB1}));
}

TEST(SafeState, WhoseGoalIsInTheWayGoesLast) {
  const std::vector<RestInTheWay> rests{{kB1, kA, kA1}};
  EXPECT_EQ(order_of_work(kTwo, rests, {}), (Jobs{kB1, kA1}));
  EXPECT_EQ(order_of_work(kTwo, rests, {kA1}), std::nullopt) << "B could never pass";
  EXPECT_EQ(order_of_work(kTwo, rests, {kB1}), (Jobs{kA1}));
}

TEST(SafeState, ASwapHasNoOrderOneByOne) {
  EXPECT_EQ(order_of_work(kTwo, {{kA1, kB, std::nullopt}, {kB1, kA, std::nullopt}}, {}),
            std::nullopt);
}

TEST(SafeState, ANextJobThatLeavesTheGoalOpensTheWay) {
  const std::vector<WaitingWork> work{{kA1, {kA}}, {kA2, {kA}}, {kB1, {kB}}};
  const std::vector<RestInTheWay> rests{{kB1, kA, kA1}};
  EXPECT_EQ(order_of_work(work, rests, {kA1}), (Jobs{kA2, kB1}));
  // ... unless B, where it is, is in the way of that.
  EXPECT_EQ(order_of_work(work, {{kB1, kA, kA1}, {kA2, kB, std::nullopt}}, {kA1}), std::nullopt);
  EXPECT_EQ(order_of_work(work, {{kB1, kA, kA1}, {kA2, kB, std::nullopt}}, {}),
            (Jobs{kB1, kA1, kA2}));
}

TEST(SafeState, JobsOfAnArmKeepTheirOrder) {
  const std::vector<WaitingWork> work{{kA1, {kA}}, {kA2, {kA}}, {kB1, {kB}}, {kB2, {kB}}};
  // B's second job needs A where its first one brings it, and A's second one B at the end.
  const std::vector<RestInTheWay> rests{
      {kB2, kA, std::nullopt}, {kB2, kA, kA2}, {kA2, kB, std::nullopt}, {kA2, kB, kB1}};
  EXPECT_EQ(order_of_work(work, rests, {}), (Jobs{kA1, kB1, kB2, kA2}));
}

TEST(SafeState, AJobOfTwoArmsGoesWhenItIsFirstOnBoth) {
  const std::vector<WaitingWork> work{{kA1, {kA}}, {kA2, {kA, kB}}, {kB1, {kB}}};
  EXPECT_EQ(order_of_work(work, {}, {}), (Jobs{kA1, kA2, kB1}));
  EXPECT_EQ(order_of_work(work, {{kA2, ArmId{2}, std::nullopt}}, {}), std::nullopt);
}

}  // namespace
}  // namespace armloom
