#include <gmock/gmock.h>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

CellDescription wrong_but_for_the_urdf(const ScratchFolder& folder) {
  CellDescription cell = two_arms_description();
  RobotDescription& robot = cell.robots[0];
  robot.srdf = folder.write("twin.srdf",
                            file_with(data_file("two_arms.srdf"), "value=\"1.5\"", "value=\"up\""));
  robot.joint_limits = folder.write("limits.yaml",
                                    "joint_limits:\n  l_turn:\n    has_velocity_limits: true\n"
                                    "    max_velocity: quick\n");
  robot.arms[0].home.clear();
  robot.arms[0].home_state = "out";
  robot.arms[0].limits["l_torn"].velocity = 1.0;
  robot.arms[1].home_state = "stretched";
  robot.arms[1].home.clear();
  robot.arms.push_back({"third", "midle_arm", {}, {}, {}});
  cell.monitor.rate_hz = 0.0;
  return cell;
}

void expect_all_told(const std::string& problems) {
  EXPECT_THAT(problems, AllOf(HasSubstr("joint l_turn: joint value is 'up'"),
                              HasSubstr("limits.yaml:4: joint l_turn: max_velocity is 'quick'"),
                              HasSubstr("home 'stretched' is not a state of group 'right_arm'"),
                              HasSubstr("arm third: group 'midle_arm' is not in twin.srdf"),
                              HasSubstr("rate_hz is 0"), Not(HasSubstr("home 'out'"))))
      << problems;
}

TEST(ReportedTogether, OtherFilesWithAValidUrdf) {
  const ScratchFolder folder;
  const std::string problems = problems_of(wrong_but_for_the_urdf(folder));
  expect_all_told(problems);
  EXPECT_THAT(problems, HasSubstr("arm left has no joint l_torn to limit"));
}

TEST(ReportedTogether, OtherFilesWithAMalformedUrdf) {
  const ScratchFolder folder;
  CellDescription cell = wrong_but_for_the_urdf(folder);
  cell.robots[0].urdf =
      folder.write("twin.urdf", file_with(data_file("two_arms.urdf"), "</robot>", ""));
  const std::string problems = problems_of(cell);
  expect_all_told(problems);
  EXPECT_THAT(problems,
              AllOf(HasSubstr("twin.urdf:5: the XML is malformed"),
                    HasSubstr("groups with movable joints: both, gripper, left_arm, right_arm"),
                    Not(HasSubstr("is not in twin.urdf"))));
}

TEST(ReportedTogether, OtherFilesWithAMissingUrdf) {
  const ScratchFolder folder;
  CellDescription cell = wrong_but_for_the_urdf(folder);
  cell.robots[0].urdf = data_file("gone.urdf");
  expect_all_told(problems_of(cell));
}

TEST(ReportedTogether, OtherFilesWithABrokenUrdfTree) {
  const ScratchFolder folder;
  CellDescription cell = wrong_but_for_the_urdf(folder);
  cell.robots[0].urdf = folder.write(
      "twin.urdf",
      file_with(data_file("two_arms.urdf"), "<child link=\"r_tip\"/>", "<child link=\"r_top\"/>"));
  const std::string problems = problems_of(cell);
  expect_all_told(problems);
  EXPECT_THAT(problems, AllOf(HasSubstr("child link r_top does not exist; did you mean r_tip?"),
                              HasSubstr("arm left has no joint l_torn to limit")));
}

TEST(ReportedTogether, WrongNamesInTheCellAndAMalformedSrdf) {
  const ScratchFolder folder;
  CellDescription cell = wrong_but_for_the_urdf(folder);
  cell.robots[0].srdf = folder.write("twin.srdf", "<robot");
  cell.robots[0].fixed["l_gripp"] = 0.0;
  EXPECT_THAT(problems_of(cell),
              AllOf(HasSubstr("twin.srdf:1: the XML is malformed"),
                    HasSubstr("arm left has no joint l_torn to limit"),
                    HasSubstr("fixed joint l_gripp is not in two_arms.urdf; did you mean l_grip?"),
                    HasSubstr("rate_hz is 0")));
}

TEST(ReportedTogether, SeveralMistakesOfOneFile) {
  const ScratchFolder folder;
  CellDescription cell = two_arms_description();
  std::string urdf = file_with(data_file("two_arms.urdf"), "radius=\"0.08\"", "radius=\"0\"");
  urdf = folder.write("twin.urdf", urdf);
  for (const auto& [from, to] : {std::pair{"multiplier=\"2\"", "multiplier=\"two\""},
                                 {"xyz=\"0 0.6 0.8\"", "xyz=\"0 0 0\""},
                                 {"scale=\"0.5 0.5 2\"", "scale=\"0.5 0 2\""}}) {
    urdf = folder.write("twin.urdf", file_with(urdf, from, to));
  }
  cell.robots[0].urdf = urdf;
  EXPECT_THAT(
      problems_of(cell),
      AllOf(HasSubstr("cylinder radius is 0 m"), HasSubstr("mimic multiplier is 'two'"),
            HasSubstr("axis xyz '0 0 0' has no direction"), HasSubstr("mesh scale holds a 0")));
}

// The joint is meant to be fixed.
TEST(ReportedTogether, InvalidFixedValueSuppressesFollowOnErrors) {
  CellDescription cell = two_arms_description();
  cell.robots[0].fixed["l_slide"] = 7.0;
  cell.robots[0].arms[0].home = {0.0};
  EXPECT_EQ(problems_of(cell),
            "/robots/0/fixed/l_slide | robot twin: joint l_slide is held at 7, outside [0.1, "
            "0.7]\n");
}

// A fixed joint needs no limits.
TEST(ReportedTogether, SharedJointSuppressesFollowOnErrors) {
  const ScratchFolder folder;
  CellDescription cell = two_arms_description();
  cell.robots[0].urdf =
      folder.write("twin.urdf", file_with(data_file("two_arms.urdf"),
                                          "<joint name=\"base_post\" type=\"fixed\">",
                                          "<joint name=\"base_post\" type=\"revolute\">"));
  for (const char* group : {"left", "right"}) {
    const std::string from = std::string("<group name=\"") + group + "_arm\">";
    const std::string to = from + "<joint name=\"base_post\"/>";
    cell.robots[0].srdf = folder.write(
        "twin.srdf", file_with(cell.robots[0].srdf, from + (group[0] == 'l' ? "<joint" : "<chain"),
                               to + (group[0] == 'l' ? "<joint" : "<chain")));
  }
  for (ArmDescription& arm : cell.robots[0].arms) arm.home.clear();
  EXPECT_EQ(problems_of(cell),
            "/robots/0/arms | robot twin: arms left, right share the movable joints base_post, so "
            "each moves the other; hold the shared joints (add to the robot \"fixed\": "
            "{\"base_post\": 0}) or make them one arm\n");
}

TEST(Remedies, ListValidNamesForMissingElements) {
  const ScratchFolder folder;
  CellDescription cell = two_arms_description();
  cell.robots[0].urdf =
      folder.write("twin.urdf", file_with(data_file("two_arms.urdf"), "mimic joint=\"l_grip\"",
                                          "mimic joint=\"drive_shaft\""));
  EXPECT_THAT(problems_of(cell),
              HasSubstr("mimic joint drive_shaft does not exist; joints that it could follow: "
                        "l_grip, l_slide, l_turn, r_bend, r_last, r_spin"));
  cell = two_arms_description();
  cell.robots[0].srdf = folder.write(
      "twin.srdf",
      file_with(data_file("two_arms.srdf"), "<joint name=\"l_turn\" value=\"1.5\"/>", ""));
  cell.robots[0].arms[0].home.clear();
  cell.robots[0].arms[0].home_state = "out";
  cell.robots[0].arms[1].home = {0.1};
  EXPECT_THAT(problems_of(cell),
              AllOf(HasSubstr("group_state out of left_arm: joint l_turn has no value; add to it "
                              "<joint name=\"l_turn\" value=\"...\"/>"),
                    HasSubstr("arm right: home has 1 values, the group has 3 joints; give one "
                              "value for each of r_spin, r_bend, r_last, or the name of a state")));
}

TEST(LimitUnits, MustMatchTheJointType) {
  CellDescription cell = two_arms_description();
  auto& limits = cell.robots[0].arms[0].limits;
  limits["l_turn"] = {.velocity = 0.1, .keys = {"velocity_m_s"}};
  limits["l_slide"] = {.upper = 0.5, .brake = 3.0, .keys = {"upper_rad", "brake_m_s2"}};
  EXPECT_EQ(problems_of(cell),
            "/robots/0/arms/0/limits/l_slide/upper_rad | joint l_slide: upper_rad is for rotating "
            "joints, but this joint is prismatic: give "
            "upper_m\n/robots/0/arms/0/limits/l_turn/velocity_m_s | joint l_turn: velocity_m_s is "
            "for prismatic joints, but this joint rotates: give velocity_rad_s\n");
}

TEST(Grippers, StartAtThePositionInTheCellFile) {
  CellDescription cell = two_arms_description();
  cell.robots[0].arms[0].gripper["l_grip"] = 0.03;
  const CellPtr built = build_or_fail(cell);
  const JointId grip = built->find_joint("t_l_grip").value();
  EXPECT_DOUBLE_EQ(built->home()[static_cast<Eigen::Index>(grip.index())], 0.03);
  EXPECT_DOUBLE_EQ(
      build_or_fail(two_arms_description())->home()[static_cast<Eigen::Index>(grip.index())], 0.0);
}

TEST(Grippers, RejectInvalidStartPositions) {
  CellDescription cell = two_arms_description();
  cell.robots[0].arms[0].gripper = {
      {"l_grip", 0.5}, {"l_turn", 0.0}, {"l_grip_mirror", 0.0}, {"thumb", 0.0}};
  EXPECT_EQ(problems_of(cell),
            "/robots/0/arms/0/gripper/l_grip | arm left: joint l_grip of its gripper starts at "
            "0.5, outside [0, 0.04] m\n/robots/0/arms/0/gripper/l_grip_mirror | arm left has no "
            "gripper joint l_grip_mirror (a movable joint below the arm, in no arm's group, that "
            "follows no other joint)\n/robots/0/arms/0/gripper/l_turn | arm left has no gripper "
            "joint l_turn (a movable joint below the arm, in no arm's group, that follows no other "
            "joint)\n/robots/0/arms/0/gripper/thumb | arm left: joint thumb of its gripper is not "
            "in two_arms.urdf\n");
}

TEST(Mimics, BeyondTheirOwnLimitsCauseAWarning) {
  const ScratchFolder folder;
  CellDescription cell = two_arms_description();
  cell.robots[0].urdf = folder.write(
      "twin.urdf", file_with(data_file("two_arms.urdf"), "offset=\"0.001\"", "offset=\"9\""));
  EXPECT_EQ(warnings_of(cell),
            "twin.urdf:40: joint l_grip_mirror | twin.urdf:40: joint l_grip_mirror: it follows "
            "l_grip from 9 to 9.08, beyond its own limits [0, 0.08]: it is checked at these "
            "positions, but the robot may stop short of them; check <mimic>\n");
  EXPECT_EQ(warnings_of(two_arms_description()), "");
}

TEST(VirtualJoints, WithAChildOtherThanTheRootCauseAWarning) {
  const ScratchFolder folder;
  CellDescription cell = two_arms_description();
  cell.robots[0].srdf = folder.write(
      "twin.srdf",
      file_with(data_file("two_arms.srdf"), "child_link=\"base\"", "child_link=\"post\""));
  EXPECT_THAT(warnings_of(cell), HasSubstr("twin.srdf:3: virtual_joint: child_link post is not the "
                                           "root link base of two_arms.urdf; it is left out"));
}

}  // namespace
}  // namespace armloom
