#include <gmock/gmock.h>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

std::vector<std::string> names_of(const Cell& cell, const std::vector<LinkId>& links) {
  std::vector<std::string> names;
  for (const LinkId link : links) names.push_back(cell.link(link).name);
  return names;
}

bool allows(const Cell& cell, const std::string& a, const std::string& b) {
  return cell.allowed.allows(*cell.find_link(a), *cell.find_link(b));
}

TEST(Arms, ListIndependentJointsFromBaseToTip) {
  const CellPtr cell = build_or_fail(two_arms_description());
  EXPECT_THAT(names_of(*cell, cell->arms[0].joints), ElementsAre("t_l_slide", "t_l_turn"));
  EXPECT_THAT(names_of(*cell, cell->arms[1].joints),
              ElementsAre("t_r_spin", "t_r_bend", "t_r_last"));
}

TEST(Arms, OwnTheirGripperAndTheLinksThatTheyMove) {
  const CellPtr cell = build_or_fail(two_arms_description());
  const Arm& left = cell->arms[0];
  EXPECT_THAT(names_of(*cell, left.gripper_joints), ElementsAre("t_l_grip"));
  EXPECT_EQ(cell->joint(left.gripper_joints[0]).arm, ArmId(0));
  EXPECT_THAT(names_of(*cell, left.links),
              UnorderedElementsAre("t_l1", "t_l2", "t_l_hand", "t_l_finger1", "t_l_finger2"));
  EXPECT_THAT(cell->arms[1].gripper_joints, testing::IsEmpty());
  EXPECT_EQ(cell->link(*cell->find_link("t_post")).arm, std::nullopt);
  EXPECT_EQ(cell->link(*cell->find_link("t_r3")).arm, ArmId(1));
}

TEST(Arms, StartAtHomeAndOtherJointsAtZeroWithinLimits) {
  const CellPtr cell = build_or_fail(two_arms_description());
  const Configuration q = cell->home();
  const auto at_home = [&](const char* joint) {
    return q[static_cast<Eigen::Index>(cell->find_joint(joint)->index())];
  };
  EXPECT_EQ(at_home("t_l_slide"), 0.3);
  EXPECT_EQ(at_home("t_l_turn"), -0.5);
  EXPECT_EQ(at_home("t_l_grip"), 0.0);
  EXPECT_EQ(at_home("t_r_spin"), 0.0);
  EXPECT_EQ(at_home("t_r_bend"), 0.4);  // its limits exclude zero
}

TEST(Arms, StoreNamedStatesInJointOrder) {
  const CellPtr cell = build_or_fail(two_arms_description());
  ASSERT_TRUE(cell->arms[0].named_states.contains("out"));
  EXPECT_EQ(cell->arms[0].named_states.at("out"), Eigen::Vector2d(0.2, 1.5));
}

class StatesOfBothArms : public testing::Test {
 protected:
  // Returns the cell with a state "tucked" of the group "both" and the home of the left arm.
  CellDescription cell_with(const std::string& r_bend, const std::string& home) const {
    CellDescription cell = two_arms_description();
    cell.robots[0].srdf =
        folder_.write("both.srdf", file_with(data_file("two_arms.srdf"), "</robot>",
                                             R"(
  <group_state name="tucked" group="both"><joint name="l_turn" value="0.4"/>
    <joint name="l_slide" value="0.5"/><joint name="r_spin" value="1"/>)" +
                                                 r_bend + R"(</group_state>
  <group_state name="out" group="both"><joint name="l_turn" value="0.1"/>
    <joint name="l_slide" value="0.1"/></group_state></robot>)"));
    cell.robots[0].arms[0].home.clear();
    cell.robots[0].arms[0].home_state = home;
    return cell;
  }
  ScratchFolder folder_;
};

TEST_F(StatesOfBothArms, AreStatesOfEachArm) {
  const std::string rest =
      R"(<joint name="r_bend" value="0.6"/><joint name="r_last" value="0.2"/>)";
  const CellPtr cell = build_or_fail(cell_with(rest, "tucked"));
  EXPECT_EQ(cell->arms[0].home, Eigen::Vector2d(0.5, 0.4));
  EXPECT_EQ(cell->arms[1].named_states.at("tucked"), Eigen::Vector3d(1, 0.6, 0.2));
  // A state of the arm's own group comes first. The right arm has no complete state "out".
  EXPECT_EQ(cell->arms[0].named_states.at("out"), Eigen::Vector2d(0.2, 1.5));
  EXPECT_FALSE(cell->arms[1].named_states.contains("out"));
}

TEST_F(StatesOfBothArms, ApplyOnlyToArmsWithAllJoints) {
  const CellPtr cell = build_or_fail(cell_with("", "tucked"));
  EXPECT_TRUE(cell->arms[0].named_states.contains("tucked"));
  EXPECT_FALSE(cell->arms[1].named_states.contains("tucked"));
  CellDescription right = cell_with("", "tucked");
  right.robots[0].arms[1].home_state = "tucked";
  EXPECT_THAT(problems_of(right), HasSubstr("home 'tucked' is not a state of group 'right_arm' in "
                                            "both.srdf; its states: none"));
}

TEST(Arms, UseTheLimitsOfTheCellFile) {
  auto description = two_arms_description();
  description.robots[0].arms[0].limits["l_turn"] = {
      .acceleration = 2.0, .jerk = 100.0, .brake = std::nullopt};
  description.robots[0].arms[0].limits["l_grip"] = {
      .acceleration = std::nullopt, .jerk = std::nullopt, .brake = 1.0};
  const CellPtr cell = build_or_fail(description);
  const Joint& turn = cell->joint(*cell->find_joint("t_l_turn"));
  EXPECT_EQ(turn.acceleration_max, 2.0);
  EXPECT_EQ(turn.jerk_max, 100.0);
  EXPECT_EQ(turn.brake, 4.0);
  EXPECT_EQ(turn.velocity_max, 2.0);
  EXPECT_EQ(turn.lower, -2.0);
  EXPECT_EQ(turn.upper, 2.5);
  EXPECT_EQ(cell->joint(*cell->find_joint("t_l_grip")).brake, 1.0);
  const Joint& endless = cell->joint(*cell->find_joint("t_r_spin"));
  EXPECT_EQ(endless.upper, kFarthestPosition);
  EXPECT_FALSE(endless.has_lower());
  EXPECT_FALSE(endless.has_upper());
}

TEST(Links, ComeAfterTheirParentsAndCarryTheirShapes) {
  const CellPtr cell = build_or_fail(two_arms_description());
  for (std::size_t l = 0; l < cell->links.size(); ++l) {
    if (!cell->links[l].parent) continue;
    EXPECT_LT(cell->links[l].parent->index(), l) << cell->links[l].name;
  }
  const Link& post = cell->link(*cell->find_link("t_post"));
  ASSERT_EQ(post.shapes.size(), 2u);
  EXPECT_EQ(std::get<Cylinder>(post.shapes[0].shape).length_m, 1.0);
  EXPECT_EQ(post.shapes[0].X_LS.translation(), Eigen::Vector3d(0, 0, 0.5));
  EXPECT_EQ(std::get<Sphere>(post.shapes[1].shape).radius_m, 0.09);
  const Link& l2 = cell->link(*cell->find_link("t_l2"));
  ASSERT_EQ(l2.shapes.size(), 1u);
  EXPECT_THAT(std::get<Mesh>(l2.shapes[0].shape).path,
              testing::EndsWith("test/model/data/shapes/tetra.stl"));
  EXPECT_EQ(std::get<Mesh>(l2.shapes[0].shape).scale, Eigen::Vector3d(0.5, 0.5, 2));
}

TEST(AllowedPairs, IncludeSrdfPairsAndRigidlyConnectedLinks) {
  const CellPtr cell = build_or_fail(two_arms_description());
  EXPECT_TRUE(allows(*cell, "t_base", "t_post"));      // rigid
  EXPECT_TRUE(allows(*cell, "t_l_hand", "t_l2"));      // rigid
  EXPECT_TRUE(allows(*cell, "t_r1", "t_r2"));          // SRDF
  EXPECT_TRUE(allows(*cell, "t_l_hand", "t_l1"));      // disabled by default
  EXPECT_FALSE(allows(*cell, "t_l_hand", "t_r_tip"));  // and enabled again
  EXPECT_FALSE(allows(*cell, "t_post", "t_l1"));       // adjacent, but not disabled in the SRDF
  EXPECT_FALSE(allows(*cell, "t_r3", "t_r_tip"));
}

TEST(AllowedPairs, OfDifferentArmsOrStaticLinksMustBeProven) {
  const ScratchFolder folder;
  CellDescription description = two_arms_description();
  const std::string pair = "<disable_collisions link1=\"r2\" link2=\"r1\" reason=\"Adjacent\"/>";
  const auto disable = [](const std::string& a, const std::string& b) {
    return "\n<disable_collisions link1=\"" + a + "\" link2=\"" + b + "\"/>";
  };
  description.robots[0].srdf =
      folder.write("twin.srdf", file_with(data_file("two_arms.srdf"), pair,
                                          pair + disable("r3", "l2") + disable("l2", "base") +
                                              disable("l2", "post") + disable("l2", "r1")));
  description.allowed_collisions = {{"t_base", "t_l2"}};
  const CellPtr cell = build_or_fail(description);
  const auto link = [&](const char* name) { return *cell->find_link(name); };
  EXPECT_THAT(cell->allowed.claimed_pairs,
              ElementsAre(testing::Pair(LinkPair{link("t_base"), link("t_l2")}, "twin.srdf:18"),
                          testing::Pair(LinkPair{link("t_l2"), link("t_r3")}, "twin.srdf:17")))
      << "r1 has no shape";
  EXPECT_FALSE(allows(*cell, "t_l2", "t_r3"));
  EXPECT_TRUE(allows(*cell, "t_l2", "t_base")) << "by the cell file";
  EXPECT_TRUE(allows(*cell, "t_l2", "t_post")) << "its mount";
}

TEST(AllowedPairs, IncludeAdjacentLinksIfThereIsNoSrdf) {
  auto description = two_pandas_description();
  for (auto& robot : description.robots) {
    robot.srdf.clear();
    robot.arms[0].group.clear();
    robot.arms[0].home.clear();
  }
  const CellPtr cell = build_or_fail(description);
  EXPECT_EQ(cell->arms[0].joints.size(), 8u);  // without groups the finger belongs to the arm
  EXPECT_TRUE(allows(*cell, "left_panda_link3", "left_panda_link4"));
  EXPECT_FALSE(allows(*cell, "left_panda_link3", "left_panda_link5"));
  EXPECT_FALSE(allows(*cell, "left_panda_link3", "right_panda_link4"));
}

TEST(AllowedPairs, AcceptLinksOfAnyRobotFromTheCellFile) {
  auto description = two_pandas_description();
  description.allowed_collisions.emplace_back("right_panda_link0", "left_panda_link0");
  const CellPtr cell = build_or_fail(description);
  EXPECT_TRUE(allows(*cell, "left_panda_link0", "right_panda_link0"));
}

// Returns a torso under both arms; `torso_type` is its joint's type.
std::string torso_urdf(const std::string& torso_type) {
  const auto revolute = [](const std::string& name, const std::string& parent,
                           const std::string& child) {
    return "<joint name='" + name + "' type='revolute'><parent link='" + parent +
           "'/><child link='" + child +
           "'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>";
  };
  return "<robot name='r'><link name='base'/><link name='torso'/><link name='a'/><link name='b'/>"
         "<joint name='waist' type='" +
         torso_type +
         "'><parent link='base'/><child link='torso'/>"
         "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint>" +
         revolute("ja", "torso", "a") + revolute("jb", "torso", "b") + "</robot>";
}

CellDescription torso_cell(const ScratchFolder& folder, const std::string& torso_type,
                           const std::string& group_a) {
  RobotDescription robot;
  robot.name = "r";
  robot.urdf = folder.write("r.urdf", torso_urdf(torso_type));
  robot.srdf =
      folder.write("r.srdf", "<robot name='r'><group name='ga'>" + group_a +
                                 "</group><group name='gb'><joint name='jb'/></group></robot>");
  robot.arms = {{"A", "ga", {}, {}, {}}, {"B", "gb", {}, {}, {}}};
  CellDescription cell;
  cell.robots.push_back(robot);
  return cell;
}

TEST(SharedJoints, AreRejectedIfTheTorsoBelongsToOneArm) {
  const ScratchFolder folder;
  EXPECT_THAT(
      problems_of(torso_cell(folder, "revolute", "<joint name='waist'/><joint name='ja'/>")),
      HasSubstr("/robots/0/arms | robot r: arms A, B share the movable joints waist, so each moves "
                "the other; hold the shared joints (add to the robot \"fixed\": {\"waist\": 0}) or "
                "make them one arm"));
}

TEST(SharedJoints, AreRejectedIfTheTorsoBelongsToNoArm) {
  const ScratchFolder folder;
  EXPECT_THAT(problems_of(torso_cell(folder, "revolute", "<joint name='ja'/>")),
              HasSubstr("add to the robot \"fixed\": {\"waist\": 0}"));
}

TEST(SharedJoints, AreRejectedIfTwoGroupsContainTheSameJoint) {
  const ScratchFolder folder;
  EXPECT_THAT(problems_of(torso_cell(folder, "fixed", "<joint name='ja'/><joint name='jb'/>")),
              HasSubstr("arms A, B share the movable joints jb"));
}

TEST(SharedJoints, ExcludeAFixedTorso) {
  const ScratchFolder folder;
  EXPECT_EQ(problems_of(torso_cell(folder, "fixed", "<joint name='waist'/><joint name='ja'/>")),
            "");
}

}  // namespace
}  // namespace armloom
