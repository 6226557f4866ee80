#include "core/model/payload.h"

#include <gmock/gmock.h>

#include <vector>

namespace armloom {
namespace {

using ::testing::HasSubstr;

// An arm with one link, which carries at most 4 kg and then keeps a quarter of its brake.
struct Carrier {
  Carrier() {
    cell.arms.push_back({.name = "left",
                         .robot = RobotId{0},
                         .group = {},
                         .joints = {},
                         .gripper_joints = {},
                         .links = {},
                         .home = {},
                         .named_states = {},
                         .payload = PayloadDescription{4.0, 0.25, 0.1}});
    cell.links.push_back({.name = "hand",
                          .robot = RobotId{0},
                          .arm = ArmId{0},
                          .parent = {},
                          .driver = {},
                          .shapes = {}});
  }
  std::vector<Attachment>& hold(double kg, double lever_m = 0.0) {
    Attachment one{.object = {}, .link = LinkId{0}, .touch = {}};
    one.object.name = "part";
    one.object.mass = {kg, {0.0, 0.0, lever_m}};
    held.push_back(one);
    return held;
  }
  Cell cell;
  std::vector<Attachment> held;
};

TEST(Payload, AnEmptyHandKeepsTheBrake) {
  Carrier arm;
  EXPECT_EQ(kept_brake(arm.cell, ArmId{0}, arm.held), 1.0);
  EXPECT_EQ(kept_brake(arm.cell, ArmId{0}, arm.hold(0.0)), 1.0);
}

TEST(Payload, TheBrakeFallsInProportionToTheMass) {
  Carrier arm;
  EXPECT_DOUBLE_EQ(kept_brake(arm.cell, ArmId{0}, arm.hold(2.0)), 0.625);
  EXPECT_DOUBLE_EQ(kept_brake(arm.cell, ArmId{0}, arm.hold(2.0)), 0.25) << "two objects";
}

TEST(Payload, AMassBeyondTheLeverCountsMore) {
  Carrier arm;
  arm.hold(1.0, 0.1);
  EXPECT_DOUBLE_EQ(counted_mass(arm.cell, ArmId{0}, arm.held), 1.0);
  arm.held.front().X_LO.translation() = Eigen::Vector3d(0.0, 0.0, 0.2);
  EXPECT_DOUBLE_EQ(counted_mass(arm.cell, ArmId{0}, arm.held), 3.0);
}

TEST(Payload, NothingTooHeavyIsHeld) {
  Carrier arm;
  EXPECT_FALSE(find_overload(arm.cell, ArmId{0}, arm.hold(4.0)));
  const auto overload = find_overload(arm.cell, ArmId{0}, arm.hold(0.1));
  ASSERT_TRUE(overload);
  EXPECT_EQ(overload->slug, "too-heavy");
  EXPECT_THAT(overload->detail, HasSubstr("arm left would hold 4.1 kg"));
}

TEST(Payload, AnArmWithoutOneHoldsNoMass) {
  Carrier arm;
  arm.cell.arms.front().payload.reset();
  EXPECT_FALSE(find_overload(arm.cell, ArmId{0}, arm.hold(0.0)));
  const auto overload = find_overload(arm.cell, ArmId{0}, arm.hold(0.1));
  ASSERT_TRUE(overload);
  EXPECT_EQ(overload->slug, "payload-unknown");
}

}  // namespace
}  // namespace armloom
