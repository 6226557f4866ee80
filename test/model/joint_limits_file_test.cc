#include <gmock/gmock.h>

#include <numbers>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kTurnLimits =
    "default_velocity_scaling_factor: 0.1\n"
    "joint_limits:\n"
    "  l_turn:\n"
    "    has_velocity_limits: true\n"
    "    max_velocity: 1.5\n"
    "    has_acceleration_limits: true\n"
    "    max_acceleration: 2\n"
    "    has_jerk_limits: false\n"
    "    max_jerk: 7\n"
    "    has_position_limits: true\n"
    "    min_position: -1.5\n"
    "    max_position: 9\n";

TEST(JointLimitsFile, YieldsToTheCellAndNeverExceedsTheUrdf) {
  const ScratchFolder folder;
  CellDescription description = with_limits_file(folder, kTurnLimits);
  description.robots[0].arms[0].limits["l_turn"].acceleration = 3.0;
  const CellPtr cell = build_or_fail(description);
  const Joint& turn = joint_of(*cell, "t_l_turn");
  EXPECT_EQ(turn.velocity_max, 1.5);       // the file's
  EXPECT_EQ(turn.acceleration_max, 3.0);   // the cell's
  EXPECT_EQ(turn.jerk_max, kDefaultJerk);  // has_jerk_limits is false
  EXPECT_EQ(turn.lower, -1.5);
  EXPECT_EQ(turn.upper, 2.5);  // the URDF's
  EXPECT_FALSE(turn.assumed.acceleration);
  EXPECT_TRUE(turn.assumed.jerk);
  EXPECT_THAT(warnings_of(description),
              HasSubstr("joint_limits.yaml:3: joint l_turn: max_position is 9, wider than the "
                        "URDF's 2.5; the URDF's value applies"));
}

TEST(JointLimitsFile, IsFoundUnderRos2ParameterNames) {
  const ScratchFolder folder;
  const CellPtr cell = build_or_fail(with_limits_file(
      folder,
      "/**:\n  ros__parameters:\n    robot_description_planning:\n      joint_limits:\n"
      "        l_turn: {has_velocity_limits: true, max_velocity: 1}\n"));
  EXPECT_EQ(joint_of(*cell, "t_l_turn").velocity_max, 1.0);
}

TEST(JointLimitsFile, AcceptsAnglesInDegrees) {
  const ScratchFolder folder;
  const CellPtr cell = build_or_fail(with_limits_file(
      folder,
      "joint_limits:\n  l_turn: {max_velocity: !degrees 45, max_acceleration: !radians 2,\n"
      "    max_position: !degrees 90, min_position: !!float -1, max_jerk: '7'}\n"));
  const Joint& turn = joint_of(*cell, "t_l_turn");
  EXPECT_DOUBLE_EQ(turn.velocity_max, std::numbers::pi / 4);
  EXPECT_EQ(turn.acceleration_max, 2.0);
  EXPECT_DOUBLE_EQ(turn.upper, std::numbers::pi / 2);
  EXPECT_EQ(turn.lower, -1.0);
  EXPECT_EQ(turn.jerk_max, 7.0);
  EXPECT_THAT(
      problems_of(with_limits_file(folder, "joint_limits:\n  l_turn: {max_velocity: !rpm 10}\n")),
      HasSubstr("joint_limits.yaml:2: joint l_turn: max_velocity has the unknown tag !rpm; use "
                "!degrees or !radians"));
}

TEST(JointLimitsFile, ReportsMistakesWithLineAndValue) {
  const ScratchFolder folder;
  EXPECT_THAT(problems_of(with_limits_file(folder, "joint_limits:\n  l_turn: [\n")),
              HasSubstr("joint_limits.yaml:3: the YAML is malformed"));
  EXPECT_THAT(problems_of(with_limits_file(folder, "limits: {}\n")),
              HasSubstr("joint_limits.yaml: there is no joint_limits with joints in it; it must "
                        "contain joint_limits: and below it"));
  const std::string problems = problems_of(with_limits_file(
      folder,
      "joint_limits:\n  l_turn:\n    has_velocity_limits: true\n    max_velocity: fast\n"
      "    has_acceleration_limits: true\n    max_acceleration: -1\n"
      "    has_jerk_limits: perhaps\n    has_position_limits: true\n    max_position: .nan\n"
      "  r_spin:\n    has_velocity_limits: true\n    has_velocity_limits: true\n    max_velocity: "
      "1\n"
      "  r_spin: {}\n"));
  EXPECT_THAT(problems, HasSubstr("joint_limits.yaml:4: joint l_turn: max_velocity is 'fast'"));
  EXPECT_THAT(problems,
              HasSubstr("joint_limits.yaml:6: joint l_turn: max_acceleration is -1, it must be"));
  EXPECT_THAT(
      problems,
      HasSubstr("joint_limits.yaml:7: joint l_turn: has_jerk_limits is 'perhaps', not true or"));
  EXPECT_THAT(problems, HasSubstr("min_position is missing, but has_position_limits is true"));
  EXPECT_THAT(problems, HasSubstr("joint_limits.yaml:9: joint l_turn: max_position is '.nan'"));
  EXPECT_THAT(problems,
              HasSubstr("joint_limits.yaml:12: joint r_spin: has_velocity_limits is given twice"));
  EXPECT_THAT(problems, HasSubstr("joint_limits.yaml:14: joint r_spin: more than one joint has"));
  EXPECT_THAT(
      problems_of(with_limits_file(folder,
                                   "joint_limits:\n  l_turn: {max_velocity: [1]}\n  r_spin: 3\n"
                                   "  r_bend: {min_position: 2, max_position: 1}\n")),
      AllOf(HasSubstr("l_turn: max_velocity is 'no single value', not a finite number"),
            HasSubstr("joint_limits.yaml:3: joint r_spin: limits are expected, as keys and values"),
            HasSubstr("r_bend: min_position 2 is above max_position 1")));
}

// The content of the broken file is unknown, so missing limits must not be reported in addition.
TEST(JointLimitsFile, ParseErrorSuppressesFollowOnErrors) {
  const ScratchFolder folder;
  for (const char* text : {"joint_limits:\n  l_turn: [\n", "limits: {}\n"}) {
    CellDescription cell = with_limits_file(folder, text);
    cell.robots[0].urdf = folder.write(
        "twin.urdf",
        file_with(data_file("two_arms.urdf"), "effort=\"50\" velocity=\"2\"", "effort=\"50\""));
    EXPECT_THAT(problems_of(cell),
                AllOf(StartsWith("joint_limits.yaml"), Not(HasSubstr("l_turn"))));
    cell.robots[0].joint_limits.clear();
    EXPECT_THAT(problems_of(cell), HasSubstr("gives no limit of velocity of l_turn"));
  }
}

TEST(JointLimitsFile, WarnsOfUnknownJoints) {
  const ScratchFolder folder;
  const std::string warnings = warnings_of(with_limits_file(
      folder, "joint_limits:\n  elbow: {}\n  l_turn: {max_speed: 3}\n  l_grip_mirror: 5\n"));
  EXPECT_THAT(warnings, HasSubstr("joints that are not in two_arms.urdf are left out: elbow"));
  EXPECT_THAT(warnings,
              HasSubstr("joint_limits.yaml:3: joint l_turn: max_speed is not known here"));
}

TEST(JointLimitsFile, RejectsMisspelledKeys) {
  const ScratchFolder folder;
  EXPECT_THAT(
      problems_of(with_limits_file(folder, "joint_limits:\n  l_turn: {max_velocty: 3}\n")),
      HasSubstr(
          "joint_limits.yaml:2: joint l_turn: max_velocty is not known here, so it would limit "
          "nothing; did you mean max_velocity?"));
}

TEST(JointLimitsFile, DecelerationLimitBecomesTheBrake) {
  for (const char* sign : {"-", ""}) {
    const ScratchFolder folder;
    const CellPtr cell = build_or_fail(with_limits_file(
        folder, std::string("joint_limits:\n  l_turn: {has_acceleration_limits: true, "
                            "max_acceleration: 1, has_deceleration_limits: true, "
                            "max_deceleration: ") +
                    sign + "0.5}\n"));
    EXPECT_EQ(joint_of(*cell, "t_l_turn").brake, 0.5);
  }
  const ScratchFolder folder;
  EXPECT_THAT(problems_of(with_limits_file(folder,
                                           "joint_limits:\n  l_turn:\n"
                                           "    has_deceleration_limits: true\n"
                                           "    max_deceleration: 0\n")),
              HasSubstr("joint_limits.yaml:4: joint l_turn: max_deceleration is 0, so the joint "
                        "could never stop"));
}

}  // namespace
}  // namespace armloom
