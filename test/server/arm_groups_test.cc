#include "server/import/arm_groups.h"

#include <gtest/gtest.h>

#include "core/model/srdf/srdf_reader.h"
#include "core/model/urdf/urdf_reader.h"
#include "test/server/torso_robot.h"

namespace armloom {
namespace {

class ArmGroups : public ::testing::Test {
 protected:
  void SetUp() override {
    tree_ = read_urdf(test::torso_urdf(), "/torso.urdf", {}, diagnostics_);
    ASSERT_TRUE(tree_) << diagnostics_.take().front().detail;
    choose(test::torso_srdf());
  }
  void choose(const std::string& srdf) {
    semantics_ = read_srdf(srdf, "/torso.srdf", *tree_, {}, "", diagnostics_);
    ASSERT_TRUE(semantics_) << diagnostics_.take().front().detail;
    choices_ = choose_arm_groups(*tree_, *semantics_, read_group_names(srdf));
  }
  std::string why(const std::string& group) const {
    for (const GroupChoice& choice : choices_) {
      if (choice.group == group) return choice.is_arm ? "an arm" : choice.why;
    }
    return "unknown";
  }

  Diagnostics diagnostics_;
  std::optional<RobotTree> tree_;
  std::optional<RobotSemantics> semantics_;
  std::vector<GroupChoice> choices_;
};

TEST_F(ArmGroups, AreChainsAndListsOfJoints) {
  EXPECT_EQ(why("left_arm"), "an arm");
  EXPECT_EQ(why("right_arm"), "an arm");
  EXPECT_EQ(why("both_arms"), "it is made of left_arm, right_arm");
  EXPECT_EQ(why("left_hand"), "it is an end effector");
  EXPECT_EQ(why("right_hand"), "it is moved by right_arm");
  EXPECT_EQ(why("torso"), "it moves left_arm, right_arm, head");
  EXPECT_EQ(why("left_wrist"), "it is a part of left_arm");
  EXPECT_EQ(why("left_arm_and_torso"), "it contains left_arm and joints above or below it");
  EXPECT_EQ(why("left_again"), "it has the same joints as left_arm");
  EXPECT_EQ(why("head"), "it has only 1 joint");
  EXPECT_EQ(why("tool"), "it has no movable joint");
}

// The group "all" has no subgroups. Only its joints show that it consists of two arms.
TEST_F(ArmGroups, ExcludeTheTorsoAndTheWholeRobot) {
  choose(R"(<robot name="torso_robot">
    <group name="torso"><joint name="torso_lift"/></group>
    <group name="all"><chain base_link="base" tip_link="left_3_link"/>
      <chain base_link="base" tip_link="right_3_link"/><joint name="head_pan"/></group>
    <group name="l"><chain base_link="torso_lift_link" tip_link="left_3_link"/></group>
    <group name="r"><chain base_link="torso_lift_link" tip_link="right_3_link"/></group></robot>)");
  EXPECT_EQ(why("l"), "an arm");
  EXPECT_EQ(why("r"), "an arm");
  EXPECT_EQ(why("all"), "it is made of l, r");
  EXPECT_EQ(why("torso"), "it moves l, r");
  choose(R"(<robot name="torso_robot">
    <group name="torso"><joint name="torso_lift"/></group>
    <group name="l"><joint name="left_3"/></group>
    <group name="r"><joint name="right_3"/></group></robot>)");
  EXPECT_EQ(why("torso"), "it moves l, r");
  EXPECT_EQ(why("r"), "an arm");
}

TEST_F(ArmGroups, ExcludeJointsSideBySideSuchAsWheels) {
  const std::string wheels = R"(<robot name="torso_robot"><group name="wheels">
    <joint name="left_1"/><joint name="right_1"/><joint name="head_pan"/></group>)";
  choose(wheels + R"(<group name="arm"><joint name="left_2"/><joint name="left_3"/>
    <joint name="left_finger"/></group></robot>)");
  EXPECT_EQ(why("wheels"), "none of its joints moves another");
  EXPECT_EQ(why("arm"), "an arm");
  choose(wheels + "</robot>");
  EXPECT_EQ(why("wheels"), "an arm");  // the only group
}

TEST_F(ArmGroups, MayShareATorsoThatBecomesFixed) {
  choose(R"(<robot name="torso_robot">
    <group name="l"><chain base_link="base" tip_link="left_3_link"/></group>
    <group name="r"><chain base_link="base" tip_link="right_3_link"/></group></robot>)");
  EXPECT_EQ(why("l"), "an arm");
  EXPECT_EQ(why("r"), "an arm");
  const auto above = joints_above_arms(*tree_, *semantics_, choices_);
  ASSERT_EQ(above.size(), 1U);
  EXPECT_EQ(tree_->links[*above.begin()].joint.name, "torso_lift");
}

TEST_F(ArmGroups, MayBeCombinedFromConsecutiveGroups) {
  const std::string parts = R"(<robot name="torso_robot">
    <group name="lo"><joint name="left_1"/><joint name="left_2"/></group>
    <group name="hi"><joint name="left_3"/></group>)";
  for (
      const std::string manip :
      {R"(<group name="manip"><group name="lo"/><group name="hi"/></group>)",
       R"(<group name="manip"><group name="lo"/><joint name="left_3"/></group>)",
       R"(<group name="manip"><chain base_link="torso_lift_link" tip_link="left_3_link"/></group>)"}) {
    choose(parts + manip + "</robot>");
    EXPECT_EQ(why("manip"), "an arm") << manip;
    EXPECT_EQ(why("lo"), "it is a part of manip") << manip;
    EXPECT_EQ(why("hi"), "it is a part of manip") << manip;
  }
  choose(parts + R"(<group name="manip"><group name="lo"/><group name="hi"/></group>
    <group name="hand"><joint name="left_finger"/></group>
    <group name="manip_hand"><group name="manip"/><group name="hand"/></group>
    <group name="r"><joint name="right_1"/><joint name="right_2"/><joint name="right_3"/></group>
    <group name="both_arms"><group name="manip"/><group name="r"/></group>
    <group name="all"><group name="lo"/><group name="hi"/><group name="r"/></group></robot>)");
  EXPECT_EQ(why("manip"), "an arm");
  EXPECT_EQ(why("r"), "an arm");
  EXPECT_EQ(why("hi"), "it is a part of manip");
  EXPECT_EQ(why("hand"), "it is moved by manip");
  EXPECT_EQ(why("manip_hand"), "it is made of manip, hand");
  EXPECT_EQ(why("both_arms"), "it is made of manip, r");
  EXPECT_EQ(why("all"), "it is made of lo, hi, r");
}

TEST_F(ArmGroups, IncludeARailButNoGripper) {
  const std::string arm = R"(<robot name="torso_robot">
    <group name="rail"><joint name="torso_lift"/></group>
    <group name="arm"><chain base_link="torso_lift_link" tip_link="left_3_link"/></group>)";
  choose(arm + R"(<group name="rail_arm"><group name="rail"/><group name="arm"/></group></robot>)");
  EXPECT_EQ(why("rail_arm"), "an arm");
  EXPECT_EQ(why("arm"), "it is a part of rail_arm");
  // A chain alone does not make the rail part of the arm. The rail becomes fixed instead.
  choose(arm + R"(<group name="rail_arm"><chain base_link="base" tip_link="left_3_link"/></group>
    </robot>)");
  EXPECT_EQ(why("arm"), "an arm");
  EXPECT_EQ(why("rail"), "it moves arm");
  // A wrist may have as few joints as a gripper. It is no gripper if it carries a gripper.
  const std::string wrist = arm + R"(<group name="wrist"><joint name="left_finger"/></group>
    <group name="arm_wrist"><group name="arm"/><group name="wrist"/></group>)";
  choose(wrist + "</robot>");
  EXPECT_EQ(why("arm"), "an arm");
  EXPECT_EQ(why("arm_wrist"), "it is made of arm, wrist");
  choose(wrist + R"(<end_effector name="e" parent_link="left_3_link" group="wrist"/></robot>)");
  EXPECT_EQ(why("wrist"), "it is an end effector");
  EXPECT_EQ(why("arm_wrist"), "it is made of arm, wrist");
  choose(R"(<robot name="torso_robot">
    <group name="most"><joint name="torso_lift"/><joint name="left_1"/><joint name="left_2"/></group>
    <group name="wrist"><joint name="left_3"/></group>
    <group name="hand"><joint name="left_finger"/></group>
    <group name="arm"><group name="most"/><group name="wrist"/></group></robot>)");
  EXPECT_EQ(why("arm"), "an arm");
  EXPECT_EQ(why("hand"), "it is moved by arm");
}

TEST_F(ArmGroups, DoNotIncludeASharedTorso) {
  choose(R"(<robot name="torso_robot">
    <group name="torso"><joint name="torso_lift"/></group>
    <group name="l"><chain base_link="torso_lift_link" tip_link="left_3_link"/></group>
    <group name="r"><chain base_link="torso_lift_link" tip_link="right_3_link"/></group>
    <group name="l_torso"><group name="torso"/><group name="l"/></group>
    <group name="r_torso"><group name="torso"/><group name="r"/></group></robot>)");
  EXPECT_EQ(why("l"), "an arm");
  EXPECT_EQ(why("r"), "an arm");
  EXPECT_EQ(why("torso"), "it moves l, r");
  EXPECT_EQ(why("l_torso"), "it is made of torso, l");
}

TEST_F(ArmGroups, LeaveTheTorsoAboveThemFixed) {
  const auto above = joints_above_arms(*tree_, *semantics_, choices_);
  ASSERT_EQ(above.size(), 1U);
  EXPECT_EQ(tree_->links[*above.begin()].joint.name, "torso_lift");
}

}  // namespace
}  // namespace armloom
