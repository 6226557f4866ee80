#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "core/model/kinematics.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::HasSubstr;

TEST(Mimic, MimicOfAMimicFollowsTheDrivingJoint) {
  const ScratchFolder folder;
  CellDescription description = two_arms_description();
  description.robots[0].urdf = folder.write(
      "twin.urdf",
      file_with(data_file("two_arms.urdf"), "<link name=\"r1\"/>",
                "<link name=\"r1\"/><link name=\"l_finger3\"/>"
                "<joint name=\"a_third\" type=\"prismatic\"><parent link=\"l_hand\"/>"
                "<child link=\"l_finger3\"/><axis xyz=\"1 0 0\"/>"
                "<limit lower=\"-1\" upper=\"1\" effort=\"20\" velocity=\"0.4\"/>"
                "<mimic joint=\"l_grip_mirror\" multiplier=\"-3\" offset=\"0.01\"/></joint>"));
  const CellPtr cell = build_or_fail(description);
  const Link& third = cell->links[cell->find_link("t_l_finger3")->index()];
  EXPECT_EQ(third.driver, cell->find_joint("t_l_grip"));
  EXPECT_DOUBLE_EQ(third.multiplier, -3.0 * 2.0);
  EXPECT_DOUBLE_EQ(third.offset, -3.0 * 0.001 + 0.01);
}

TEST(Mimic, CycleIsReportedForEveryJoint) {
  const ScratchFolder folder;
  CellDescription description = two_arms_description();
  description.robots[0].urdf = folder.write(
      "twin.urdf",
      file_with(data_file("two_arms.urdf"), "name=\"l_grip\" type=\"prismatic\">",
                "name=\"l_grip\" type=\"prismatic\"><mimic joint=\"l_grip_mirror\"/>"));
  const std::string problems = problems_of(description);
  EXPECT_THAT(problems, HasSubstr("twin.urdf:36: joint l_grip: mimic joint l_grip_mirror and the "
                                  "joints that it follows form a cycle"));
  EXPECT_THAT(problems, HasSubstr("twin.urdf:40: joint l_grip_mirror: mimic joint l_grip and the "
                                  "joints that it follows form a cycle"));
}

TEST(CellLimits, MustNotExceedTheUrdfLimits) {
  CellDescription cell = two_arms_description();
  cell.robots[0].arms[0].limits["l_turn"] = {.lower = -2.5, .upper = 3.0, .velocity = 2.5};
  const std::string problems = problems_of(cell);
  EXPECT_THAT(problems, HasSubstr("/robots/0/arms/0/limits/l_turn/lower_rad | joint l_turn: "
                                  "lower_rad is -2.5, wider than the URDF's -2"));
  EXPECT_THAT(problems, HasSubstr("upper_rad is 3, wider than the URDF's 2.5"));
  EXPECT_THAT(problems, HasSubstr("velocity_rad_s is 2.5, wider than the URDF's 2"));
  cell.robots[0].arms[0].limits["l_turn"] = {.lower = -1.0, .upper = 1.0, .velocity = 0.5};
  cell.robots[0].arms[1].limits["r_spin"] = {.lower = -3.0, .upper = 3.0};
  const CellPtr built = build_or_fail(cell);
  EXPECT_EQ(joint_of(*built, "t_l_turn").lower, -1.0);
  EXPECT_EQ(joint_of(*built, "t_l_turn").velocity_max, 0.5);
  EXPECT_EQ(joint_of(*built, "t_r_spin").upper, 3.0);
}

TEST(Homes, MayNameAGroupState) {
  CellDescription cell = two_arms_description();
  cell.robots[0].arms[0].home.clear();
  cell.robots[0].arms[0].home_state = "out";
  EXPECT_EQ(build_or_fail(cell)->arms[0].home, Eigen::Vector2d(0.2, 1.5));
  cell.robots[0].arms[0].home_state = "ready";
  EXPECT_THAT(problems_of(cell),
              HasSubstr("/robots/0/arms/0/home | arm left: home 'ready' is not a state of group "
                        "'left_arm' in two_arms.srdf; its states: out"));
}

TEST(FixedJoints, AreRemovedFromTheCellAtTheirFixedPosition) {
  CellDescription free = two_arms_description();
  CellDescription held = two_arms_description();
  held.robots[0].fixed = {{"l_slide", 0.3}, {"r_bend", 0.7}};
  const CellPtr a = build_or_fail(free);
  const CellPtr b = build_or_fail(held);
  EXPECT_FALSE(b->find_joint("t_l_slide").has_value());
  ASSERT_EQ(b->arms[0].home.size(), 1);  // a home of the whole group is accepted too
  EXPECT_EQ(b->arms[0].home[0], -0.5);
  EXPECT_FALSE(b->link(*b->find_link("t_l1")).arm.has_value());

  Configuration q = a->home();
  q[static_cast<Eigen::Index>(a->find_joint("t_r_bend")->index())] = 0.7;
  LinkPoses X_a, X_b;
  forward_kinematics(*a, q, X_a);
  forward_kinematics(*b, b->home(), X_b);
  for (std::size_t l = 0; l < X_a.size(); ++l)  // r3 follows r_bend as a mimic
    EXPECT_TRUE(X_a[l].isApprox(X_b[l], 1e-12)) << a->links[l].name;
}

// With multiplier 0 the joint of l_finger2 never moves, so l_finger2 is fixed to its parent.
TEST(FixedJoints, IncludeMimicsWithMultiplierZero) {
  const ScratchFolder folder;
  CellDescription still = two_arms_description();
  still.robots[0].urdf = folder.write(
      "still.urdf", file_with(data_file("two_arms.urdf"),
                              "<mimic joint=\"l_grip\" multiplier=\"2\" offset=\"0.001\"/>",
                              "<mimic joint=\"r_bend\" multiplier=\"0\" offset=\"0.02\"/>"));
  const CellPtr cell = build_or_fail(still);
  const Link& finger = cell->link(*cell->find_link("t_l_finger2"));
  EXPECT_FALSE(finger.driver.has_value());
  EXPECT_EQ(finger.arm, ArmId{0});  // the arm that carries the finger
  EXPECT_NEAR(finger.X_PJ.translation().y(), -0.02, 1e-12);
}

TEST(FixedJoints, AreFixedInTheUrdfForTheDashboard) {
  const ScratchFolder folder;
  CellDescription held = two_arms_description();
  held.robots[0].fixed = {{"l_slide", 0.3}, {"r_bend", 0.7}};
  const CellPtr cell = build_or_fail(held);
  CellDescription again = two_arms_description();
  again.robots[0].urdf = folder.write("again.urdf", cell->robots[0].urdf_text);
  again.robots[0].arms[0].home = {-0.5};
  const CellPtr read = build_or_fail(again);
  LinkPoses X_a, X_b;
  forward_kinematics(*cell, cell->home(), X_a);
  forward_kinematics(*read, read->home(), X_b);
  ASSERT_EQ(X_a.size(), X_b.size());
  for (std::size_t l = 0; l < X_a.size(); ++l)
    EXPECT_TRUE(X_a[l].isApprox(X_b[l], 1e-12)) << cell->links[l].name;
}

TEST(FixedJoints, AreRejectedWithNameAndValue) {
  CellDescription cell = two_arms_description();
  cell.robots[0].fixed = {
      {"l_slide", 0.05}, {"l_grip_mirror", 0}, {"base_post", 0}, {"waist", 1}, {"r_spin", NAN}};
  const std::string problems = problems_of(cell);
  EXPECT_THAT(problems, HasSubstr("/robots/0/fixed/l_slide | robot twin: joint l_slide is held at "
                                  "0.05, outside [0.1, 0.7]"));
  EXPECT_THAT(problems,
              HasSubstr("joint l_grip_mirror follows joint l_grip: hold that joint instead"));
  EXPECT_THAT(problems, HasSubstr("joint base_post is already fixed in two_arms.urdf"));
  EXPECT_THAT(problems, HasSubstr("fixed joint waist is not in two_arms.urdf"));
  EXPECT_THAT(problems, HasSubstr("joint r_spin is held at nan"));
}

TEST(AllProblems, OfUrdfSrdfLimitsAndCellAreReportedTogether) {
  const ScratchFolder folder;
  CellDescription cell = with_limits_file(
      folder, "joint_limits:\n  r_bend: {has_velocity_limits: true, max_velocity: quick}\n");
  cell.robots[0].urdf = folder.write(
      "twin.urdf",
      file_with(data_file("two_arms.urdf"), "sphere radius=\"0.09\"", "sphere radius=\"-1\""));
  cell.robots[0].srdf = folder.write(
      "twin.srdf", file_with(data_file("two_arms.srdf"), "base_link=\"post\"", "base_link=\"l1\""));
  cell.robots[0].arms[0].home[1] = 7;
  cell.monitor.rate_hz = 0;
  cell.allowed_collisions.emplace_back("t_post", "chair");
  const std::string problems = problems_of(cell);
  for (const char* told :
       {"sphere radius is -1 m", "tip_link r_tip is not below", "home of t_l_turn is 7",
        "rate_hz is 0", "there is no link or object chair"}) {
    EXPECT_THAT(problems, HasSubstr(told));
  }
}

TEST(Warnings, ReportALagAboveTheCertifiedDelay) {
  CellDescription cell = two_arms_description();
  cell.robots[0].controller.lag = std::chrono::milliseconds(300);
  EXPECT_THAT(warnings_of(cell),
              HasSubstr("/robots/0/controller/lag_s | robot twin: lag_s is 0.3, more than checking "
                        "delay_s of 0.1: its arms follow late,"));
}

CellDescription with_srdf(const ScratchFolder& folder, const std::string& from,
                          const std::string& to) {
  CellDescription cell = two_arms_description();
  for (ArmDescription& arm : cell.robots[0].arms) arm.home.clear();
  cell.robots[0].srdf = folder.write("twin.srdf", file_with(data_file("two_arms.srdf"), from, to));
  return cell;
}

TEST(UngroupedJoints, AreRejectedIfTheyMoveAnArm) {
  const ScratchFolder folder;
  CellDescription cell = with_srdf(folder, "<joint name=\"l_turn\"/><joint name=\"l_slide\"/>",
                                   "<joint name=\"l_turn\"/>");
  EXPECT_THAT(problems_of(cell),
              HasSubstr("/robots/0 | robot twin: joint l_slide would move an arm but is in no "
                        "arm's group, so its position must be given: add to the robot \"fixed\": "
                        "{\"l_slide\": 0}, with its value"));
  cell.robots[0].fixed = {{"l_slide", 0.3}};
  EXPECT_EQ(problems_of(cell), "");
}

TEST(UngroupedJoints, OutsideAllArmsCauseAWarning) {
  CellDescription cell = two_arms_description();
  cell.robots[0].arms.pop_back();
  EXPECT_THAT(warnings_of(cell),
              HasSubstr("/robots/0 | robot twin: joint r_spin, r_bend is in no arm's group, so "
                        "the links that it moves are checked only at its position 0"));
}

TEST(UngroupedJoints, BetweenJointsOfAGroupCauseAWarning) {
  const ScratchFolder folder;
  const CellDescription cell = with_srdf(folder, "<chain base_link=\"post\" tip_link=\"r_tip\"/>",
                                         "<joint name=\"r_spin\"/><joint name=\"r_last\"/>");
  EXPECT_THAT(warnings_of(cell), HasSubstr("/robots/0/arms/1/group | arm right: joint r_bend is "
                                           "between joints of group 'right_arm' but not in it"));
}

TEST(FixedJoints, OverrideADifferentHomeWithAWarning) {
  CellDescription cell = two_arms_description();
  cell.robots[0].fixed = {{"l_slide", 0.3}};
  cell.robots[0].arms[0].home = {0.2, -0.5};
  const char* told = "arm left: home has joint l_slide at 0.2, but \"fixed\" holds it at 0.3";
  EXPECT_THAT(warnings_of(cell), HasSubstr(told));
  cell.robots[0].arms[0].home.clear();
  cell.robots[0].arms[0].home_state = "out";
  EXPECT_EQ(problems_of(cell), "");
  EXPECT_THAT(warnings_of(cell), HasSubstr(told));
  cell.robots[0].fixed = {{"l_slide", 0.2}};
  EXPECT_EQ(warnings_of(cell), "");
}

TEST(Warnings, ReportNoiseAboveTheCertifiedTrackingError) {
  CellDescription cell = two_arms_description();
  cell.robots[0].controller.noise_rad = 0.05;
  EXPECT_THAT(warnings_of(cell), HasSubstr("robot twin: noise_rad is 0.05, more than a sixth "
                                           "of its tracking_error_rad of 0.001"));
}

TEST(Warnings, CompareNoiseWithThePromiseOfItsController) {
  CellDescription cell = two_arms_description();
  cell.robots[0].controller.noise_rad = 0.0002;
  EXPECT_THAT(warnings_of(cell), HasSubstr("raise the controller's tracking_error_rad to 0.0012"));
  cell.robots[0].controller.tracking_error_rad = 0.002;
  EXPECT_EQ(warnings_of(cell), "");
}

TEST(Warnings, AreEmptyForTheCellsOfTheRepository) {
  EXPECT_EQ(warnings_of(two_arms_description()), "");
  EXPECT_EQ(warnings_of(two_pandas_description()), "");
}

}  // namespace
}  // namespace armloom
