// A custom policy is one value: the arm with the smaller number passes first.
#include <gmock/gmock.h>

#include <algorithm>

#include "core/precedence/open_orders.h"
#include "test/scheduler/ideal_arms.h"

namespace armloom {
namespace {

PassingOrders left_arm_first(const OrderQuestion& question) {
  OpenOrders open(question);
  if (open.blocked()) return open.refused({});
  for (OrderChoice& choice : open.choices()) {
    const OpenOrder& order = open.orders()[choice.members.front().order];
    const bool left_is_a =
        open.motions()[order.a].arms.front() < open.motions()[order.b].arms.front();
    if (std::ranges::find(choice.options, left_is_a) != choice.options.end()) {
      open.set(choice, left_is_a);
    }
  }
  Prediction prediction = open.predicted();
  return prediction.stuck.empty() ? open.admitted(std::move(prediction)) : open.stuck(prediction);
}
const Policy kLeftArmFirst{"left_arm_first", Coordinated{0.0}, left_arm_first};

// They cross in the middle of their paths.
const Crossing kCross{ArmId{0}, 0.4, 0.6, ArmId{1}, 0.4, 0.6};

TEST(LeftArmFirst, LeftArmPassesFirstAlthoughItsJobIsLater) {
  IdealArms arms(one_joint_arms(2), std::make_unique<Policy>(kLeftArmFirst), Crossings({kCross}),
                 [](JobId) { return Habits{}; });
  const JobId right = arms.submit({JobId{0}, move({1}, 0, 1, 10s), 0, 60s});
  arms.run_until(at(100ms));
  const JobId left = arms.submit({JobId{0}, move({0}, 0, 1, 10s), 0, 60s});
  arms.run_until(at(5s));
  ASSERT_TRUE(arms.job(right).pausing());
  EXPECT_EQ(arms.job(right).waits_on.front().job, left);
  EXPECT_LE(arms.stands_at(ArmId{1}), 0.4);
  arms.run();
  EXPECT_EQ(arms.state(left), JobState::succeeded);
  EXPECT_EQ(arms.state(right), JobState::succeeded);
  EXPECT_LT(*arms.job(left).ended_at(), *arms.job(right).ended_at());
}

TEST(LeftArmFirst, RightArmPassesFirstIfAlreadyInTheRegion) {
  IdealArms arms(one_joint_arms(2), std::make_unique<Policy>(kLeftArmFirst), Crossings({kCross}),
                 [](JobId) { return Habits{}; });
  const JobId right = arms.submit({JobId{0}, move({1}, 0, 1, 10s), 0, 60s});
  arms.run_until(at(5s));  // in the middle
  const JobId left = arms.submit({JobId{0}, move({0}, 0, 1, 1s), 0, 60s});
  arms.run();
  EXPECT_EQ(arms.state(left), JobState::succeeded);
  EXPECT_EQ(arms.state(right), JobState::succeeded);
  EXPECT_GT(*arms.job(left).ended_at(), at(5500ms));
}

}  // namespace
}  // namespace armloom
