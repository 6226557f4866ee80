// From a robot's own files to a cell file: what an import chooses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "core/model/cell/build_cell.h"
#include "core/model/srdf/srdf_reader.h"
#include "core/model/urdf/urdf_reader.h"
#include "server/codec/cell_codec.h"
#include "server/import/arm_groups.h"
#include "server/import/homes.h"
#include "server/import/packages.h"
#include "server/import/placement.h"
#include "server/recording/recording.h"
#include "test/server/torso_robot.h"

namespace armloom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
namespace fs = std::filesystem;

class ArmGroups : public ::testing::Test {
 protected:
  void SetUp() override {
    tree_ = read_urdf(test::torso_urdf(), "/torso.urdf", {}, findings_);
    ASSERT_TRUE(tree_) << findings_.take().front().detail;
    choose(test::torso_srdf());
  }
  void choose(const std::string& srdf) {
    semantics_ = read_srdf(srdf, "/torso.srdf", *tree_, {}, findings_);
    ASSERT_TRUE(semantics_) << findings_.take().front().detail;
    choices_ = choose_arm_groups(*tree_, *semantics_, read_group_names(srdf));
  }
  std::string why(const std::string& group) const {
    for (const GroupChoice& choice : choices_) {
      if (choice.group == group) return choice.is_arm ? "an arm" : choice.why;
    }
    return "unknown";
  }

  Findings findings_;
  std::optional<RobotTree> tree_;
  std::optional<RobotSemantics> semantics_;
  std::vector<GroupChoice> choices_;
};

TEST_F(ArmGroups, AreChainsAndListsOfJointsAndNothingElse) {
  EXPECT_EQ(why("left_arm"), "an arm");
  EXPECT_EQ(why("right_arm"), "an arm");
  EXPECT_EQ(why("both_arms"), "it is made of left_arm, right_arm");
  EXPECT_EQ(why("left_hand"), "it is an end effector");
  EXPECT_EQ(why("right_hand"), "it is moved by right_arm");
  EXPECT_EQ(why("torso"), "it moves left_arm, right_arm, head");
  EXPECT_EQ(why("left_wrist"), "it is a part of left_arm");
  EXPECT_EQ(why("left_arm_and_torso"), "it is left_arm and joints above or below it");
  EXPECT_EQ(why("left_again"), "it holds the same joints as left_arm");
  EXPECT_EQ(why("head"), "it has only 1 joint");
  EXPECT_EQ(why("tool"), "it holds no movable joint");
}

// By joints, as the groups of many a robot are: no pair of them says that the whole is two arms.
TEST_F(ArmGroups, AreNotAllOfThemTogetherNorTheTorso) {
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

TEST_F(ArmGroups, MayBothBeginAtTheBaseOfATorsoThatIsHeldThen) {
  choose(R"(<robot name="torso_robot">
    <group name="l"><chain base_link="base" tip_link="left_3_link"/></group>
    <group name="r"><chain base_link="base" tip_link="right_3_link"/></group></robot>)");
  EXPECT_EQ(why("l"), "an arm");
  EXPECT_EQ(why("r"), "an arm");
  const auto above = joints_above_arms(*tree_, *semantics_, choices_);
  ASSERT_EQ(above.size(), 1U);
  EXPECT_EQ(tree_->links[*above.begin()].joint, "torso_lift");
}

// Upper arm and forearm in groups of their own, put together by name or by a chain.
TEST_F(ArmGroups, MayBePutTogetherFromGroupsOfWhichOneMovesTheOther) {
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

TEST_F(ArmGroups, TakeARailThatTheSrdfPutsToTheArmButNoGripper) {
  const std::string arm = R"(<robot name="torso_robot">
    <group name="rail"><joint name="torso_lift"/></group>
    <group name="arm"><chain base_link="torso_lift_link" tip_link="left_3_link"/></group>)";
  choose(arm + R"(<group name="rail_arm"><group name="rail"/><group name="arm"/></group></robot>)");
  EXPECT_EQ(why("rail_arm"), "an arm");
  EXPECT_EQ(why("arm"), "it is a part of rail_arm");
  // By its joints alone a group does not say so: the rail is held.
  choose(arm + R"(<group name="rail_arm"><chain base_link="base" tip_link="left_3_link"/></group>
    </robot>)");
  EXPECT_EQ(why("arm"), "an arm");
  EXPECT_EQ(why("rail"), "it moves arm");
  // A wrist as small as a gripper is none where it moves one.
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

// What moves several arms is a torso, whatever group it is named in.
TEST_F(ArmGroups, DoNotTakeTheTorsoOfTwo) {
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

TEST_F(ArmGroups, LeaveTheTorsoAboveThemToBeHeld) {
  const auto above = joints_above_arms(*tree_, *semantics_, choices_);
  ASSERT_EQ(above.size(), 1U);
  EXPECT_EQ(tree_->links[*above.begin()].joint, "torso_lift");
}

// ---- Packages ----

class PackageFolders : public ::testing::Test {
 protected:
  void SetUp() override {
    top_ = fs::canonical(::testing::TempDir()) / "armloom-packages" /
           ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(top_);
  }
  void put(const std::string& file) const {
    fs::create_directories((top_ / file).parent_path());
    std::ofstream(top_ / file) << "x";
  }
  fs::path top_;
};

TEST_F(PackageFolders, AreFoundByTheirFiles) {
  put("ws/arm_description/meshes/link.stl");
  put("ws/arm_moveit_config/config/arm.urdf");
  put("opt/share/hand/hand.stl");
  put("ws/renamed/meshes/table.stl");
  const std::string urdf = R"(<mesh filename="package://arm_description/meshes/link.stl"/>
    <mesh filename='package://arm_description/meshes/left_out.dae'/>
    <mesh filename="package://hand/hand.stl"/> <mesh filename="package://nowhere/x.stl"/>
    <mesh filename="package://given/y.stl"/>)";
  const Packages found = find_packages(urdf, top_ / "ws/arm_moveit_config/config/arm.urdf",
                                       {{"given", top_.string()}}, {top_ / "opt/share"});
  EXPECT_THAT(
      found.folders,
      ElementsAre(Pair("arm_description", (top_ / "ws/arm_description").string()),
                  Pair("given", top_.string()), Pair("hand", (top_ / "opt/share/hand").string())));
  EXPECT_THAT(found.missing, ElementsAre("nowhere"));
  // A folder of another name that holds the files, above the URDF.
  const Packages renamed = find_packages(R"("package://table_description/meshes/table.stl")",
                                         top_ / "ws/renamed/urdf/table.urdf", {}, {});
  EXPECT_THAT(renamed.folders,
              ElementsAre(Pair("table_description", (top_ / "ws/renamed").string())));
}

// ---- Placements ----

TEST(Placement, IsReadInMetresAndDegrees) {
  const auto placed = read_placement("right:x=0.75,z=-1e-1,yaw_deg=180");
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->name, "right");
  EXPECT_EQ(placed->base.xyz_m, Eigen::Vector3d(0.75, 0, -0.1));
  EXPECT_EQ(placed->base.rpy_rad, Eigen::Vector3d(0, 0, std::numbers::pi));
  EXPECT_EQ(read_placement("left")->base.xyz_m, Eigen::Vector3d::Zero());
}

TEST(Placement, IsRefusedWithWhatIsWrong) {
  for (const auto& [text, says] :
       {std::pair{":x=1", "the name is missing"},
        {"a:w=1", "\"w\" is not known"},
        {"a:yaw=90", "\"yaw\" is not known"},
        {"a:x", "\"x\" gives no number"},
        {"a:x=1m", "\"x=1m\" gives no number"},
        {"a:x=nan", "\"x=nan\" gives no number"},
        {"a:x=1,,y=2", "\"\" is not known"},
        {":x=abc,foo=1,yaw_deg=nan",
         "the name is missing; \"x=abc\" gives no number; \"foo\" is not "
         "known; \"yaw_deg=nan\" gives no number; expected"}}) {
    const auto placed = read_placement(text);
    ASSERT_FALSE(placed) << text;
    EXPECT_EQ(placed.error().front().pointer, "--robot");
    EXPECT_THAT(placed.error().front().detail, HasSubstr(says));
  }
}

// ---- Homes ----

CellDescription facing_pandas(double apart_m) {
  const fs::path folder = fs::path(ARMLOOM_SOURCE_DIR) / "config";
  CellDescription cell =
      read_cell_text(read_text_file(folder / "two_pandas.json").value(), folder).value();
  cell.objects.clear();
  cell.allowed_collisions.clear();
  cell.robots[0].X_WB.translation() = Eigen::Vector3d(-apart_m / 2, 0, 0);
  cell.robots[1].X_WB.translation() = Eigen::Vector3d(apart_m / 2, 0, 0);
  for (RobotDescription& robot : cell.robots) robot.arms.front().home.clear();
  return cell;
}

TEST(ChosenHomes, AreTheStatesThatSpeakOfHomeWhereTheseAreFree) {
  const auto cell = build_cell(facing_pandas(2.5));
  ASSERT_TRUE(cell);
  const auto homes = choose_homes(*cell);
  ASSERT_TRUE(homes);
  EXPECT_TRUE(homes->is_free);
  for (const HomeCandidate& home : homes->of_arm) EXPECT_EQ(home.state, "home");
}

TEST(ChosenHomes, StandFreeWhereTheWantedOnesDoNot) {
  // So near that both at home would touch.
  const CellDescription near = facing_pandas(0.4);
  const auto cell = build_cell(near);
  ASSERT_TRUE(cell);
  const auto homes = choose_homes(*cell);
  ASSERT_TRUE(homes);
  ASSERT_TRUE(homes->is_free);
  EXPECT_FALSE(homes->of_arm[0].state == "home" && homes->of_arm[1].state == "home");
  const HomePlaces chosen{{{homes->of_arm[0].q, 0.02}}, {{homes->of_arm[1].q, 0.02}}};
  EXPECT_TRUE(find_free_homes(*cell, chosen).value());
  const HomePlaces wanted{{{homes->wanted[0].q, 0.02}}, {{homes->wanted[1].q, 0.02}}};
  EXPECT_FALSE(find_free_homes(*cell, wanted).value());
  const auto again = choose_homes(*cell);
  EXPECT_EQ(again->of_arm[1].q, homes->of_arm[1].q);
}

TEST(ChosenHomes, AreNotFreeWhereNothingIs) {
  const auto cell = build_cell(facing_pandas(0.0));  // one within the other
  ASSERT_TRUE(cell);
  const auto homes = choose_homes(*cell);
  ASSERT_TRUE(homes);
  EXPECT_FALSE(homes->is_free);
  EXPECT_EQ(homes->of_arm[0].state, homes->wanted[0].state);
}

TEST(HomeCandidates, KeepTheLimits) {
  const auto cell = build_cell(facing_pandas(2.5));
  ASSERT_TRUE(cell);
  const Arm& arm = (*cell)->arms.front();
  for (const HomeCandidate& candidate : home_candidates(**cell, arm)) {
    for (std::size_t j = 0; j < arm.joints.size(); ++j) {
      const Joint& joint = (*cell)->joint(arm.joints[j]);
      EXPECT_GE(candidate.q[static_cast<Eigen::Index>(j)], joint.lower);
      EXPECT_LE(candidate.q[static_cast<Eigen::Index>(j)], joint.upper);
    }
  }
}

}  // namespace
}  // namespace armloom
