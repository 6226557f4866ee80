#include <gmock/gmock.h>

#include <functional>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using namespace std::chrono_literals;

struct Doubt {
  const char* name;
  std::function<void(CellDescription&)> make;
  const char* pointer;
  const char* sentence;
};

void PrintTo(const Doubt& doubt, std::ostream* out) { *out << doubt.name; }

class DoubtfulSetting : public testing::TestWithParam<Doubt> {};

TEST_P(DoubtfulSetting, CausesAWarningWithItsConsequence) {
  CellDescription description = two_arms_description();
  GetParam().make(description);
  EXPECT_THAT(warnings_of(description), AllOf(HasSubstr(std::string(GetParam().pointer) + " | "),
                                              HasSubstr(GetParam().sentence)));
}

#define DOUBT(statement, pointer, sentence)                                  \
  Doubt {                                                                    \
#statement, [](CellDescription & cell) { statement; }, pointer, sentence \
  }

JointLimitsDescription& turn(CellDescription& cell) {
  return cell.robots[0].arms[0].limits["l_turn"];
}

INSTANTIATE_TEST_SUITE_P(
    All, DoubtfulSetting,
    testing::Values(
        DOUBT(cell.self_clearance_m = 0.05, "/self_clearance_m",
              "self_clearance_m is 0.05, more than clearance_m, so clearance_m applies: 0.02 m"),
        DOUBT(cell.mount_clearance_m = 0.05, "/mount_clearance_m", "so clearance_m applies"),
        DOUBT(cell.clearance_m = cell.monitor.stop_clearance_m = 0, "/clearance_m",
              "motions may touch, and model, mounting and measurement errors are not covered"),
        DOUBT(cell.monitor.stop_clearance_m = 0, "/monitor/stop_clearance_m",
              "the monitor stops arms only when they touch"),
        DOUBT(cell.checking.tracking_error_rad = 0, "/checking/tracking_error_rad",
              "follow their paths exactly, which no arm does"),
        DOUBT(cell.checking.tracking_error_rad = 0.2, "/checking/tracking_error_rad",
              "almost no motion will be free of conflicts"),
        DOUBT(cell.checking.limit_tolerance = 0.9, "/checking/limit_tolerance",
              "jobs may exceed the joints' velocity and acceleration limits"),
        DOUBT(cell.execution.start_tolerance_rad = 0.5, "/execution/start_tolerance_rad",
              "the motion onto the path is not checked"),
        DOUBT(cell.scheduling.policy = "timed_discrete";
              cell.checking.time_step = 5s, "/checking/time_step_s",
              "misses collisions between two such steps"),
        DOUBT(cell.monitor.reaction = 5ms, "/monitor/reaction_s",
              "reaction_s is 0.005, less than the monitor's period (0.01 s)"),
        DOUBT(cell.monitor.reaction = 5s, "/monitor/reaction_s",
              "reaction_s is 5: a stopping arm moves on that long before it brakes"),
        DOUBT(cell.robots[0].controller.tracking_error_rad = 0,
              "/robots/0/controller/tracking_error_rad", "follow their paths exactly"),
        DOUBT(cell.robots[0].controller.reaction = 800ms, "/robots/0/controller/reaction_s",
              "reaction_s is 0.8: a stopping arm moves on that long before it brakes"),
        DOUBT(cell.robots[0].controller.feedback_timeout = 5s,
              "/robots/0/controller/feedback_timeout_s",
              "other arms stay out of the 5.101 s of its path"),
        DOUBT(cell.monitor.rate_hz = 1, "/monitor/rate_hz",
              "rate_hz is 1: the monitor checks only every 1 s"),
        DOUBT(turn(cell).acceleration = 180, "two_arms.urdf:28: joint l_turn",
              "its acceleration limit is 180 rad/s^2, probably a unit error (degrees?)"),
        DOUBT(turn(cell).brake = 100, "/robots/0/arms/0/limits/l_turn/brake_rad_s2",
              "stops are certified for a brake that strong"),
        DOUBT(cell.objects[0].X_WO.translation().x() = 800, "/objects/0",
              "object table is 800 m away from the cell's origin, probably a unit error "
              "(millimeters?)"),
        DOUBT(cell.robots[0].X_WB.translation() = Eigen::Vector3d(0, -500, 0), "/robots/0/base",
              "robot twin is 500 m away")));

CellDescription with_urdf(const ScratchFolder& folder, const std::string& from,
                          const std::string& to) {
  CellDescription cell = two_arms_description();
  cell.robots[0].urdf = folder.write("twin.urdf", file_with(data_file("two_arms.urdf"), from, to));
  return cell;
}

constexpr const char* kTurnLimit =
    "<limit lower=\"-2\" upper=\"2.5\" effort=\"50\" velocity=\"2\"/>";

const Joint& turn_of(const Cell& cell) { return cell.joint(*cell.find_joint("t_l_turn")); }

TEST(SoftLimits, ApplyIfTheyAreNarrowerAsInMoveIt) {
  const ScratchFolder folder;
  const auto with_soft = [&](const std::string& attributes) {
    return with_urdf(folder, kTurnLimit,
                     kTurnLimit + ("<safety_controller " + attributes + " k_velocity=\"1\"/>"));
  };
  CellPtr cell =
      build_or_fail(with_soft("soft_lower_limit=\"-1.5\" soft_upper_limit=\"9\" k_position=\"1\""));
  EXPECT_EQ(turn_of(*cell).lower, -1.5);
  EXPECT_EQ(turn_of(*cell).upper, 2.5);
  cell = build_or_fail(with_soft(""));
  EXPECT_EQ(turn_of(*cell).lower, -2.0);
  const CellDescription empty = with_soft("soft_lower_limit=\"0\" soft_upper_limit=\"0\"");
  EXPECT_EQ(turn_of(*build_or_fail(empty)).upper, 2.5);
  EXPECT_THAT(warnings_of(empty), HasSubstr("joint l_turn: the soft limits leave no range of the "
                                            "<limit>: from 0 to 0; the <limit> applies"));
}

TEST(JointLimitsFile, AppliesLimitsUnlessTheirFlagIsFalse) {
  const ScratchFolder folder;
  CellDescription description = two_arms_description();
  description.robots[0].joint_limits = folder.write(
      "joint_limits.yaml",
      "joint_limits:\n  l_turn: {max_velocity: 0.5, max_acceleration: 1.25, max_position: 1}\n"
      "  r_bend: {has_velocity_limits: false, max_velocity: 0.1}\n");
  const CellPtr cell = build_or_fail(description);
  EXPECT_EQ(turn_of(*cell).velocity_max, 0.5);
  EXPECT_EQ(turn_of(*cell).acceleration_max, 1.25);
  EXPECT_EQ(turn_of(*cell).upper, 1.0);
  EXPECT_EQ(turn_of(*cell).lower, -2.0);
  EXPECT_EQ(cell->joint(*cell->find_joint("t_r_bend")).velocity_max, 1.0);
}

TEST(LimitsInDegrees, CauseAWarning) {
  const ScratchFolder folder;
  EXPECT_THAT(
      warnings_of(
          with_urdf(folder, kTurnLimit,
                    "<limit lower=\"-120\" upper=\"150\" effort=\"50\" velocity=\"180\"/>")),
      AllOf(
          HasSubstr(
              "joint l_turn: its limits are -120 to 150 rad, probably a unit error (degrees?)"),
          HasSubstr(
              "joint l_turn: its velocity limit is 180 rad/s, probably a unit error (degrees?)")));
}

TEST(Axes, OfNonUnitLengthAreNormalizedWithAWarning) {
  const ScratchFolder folder;
  const CellDescription cell =
      with_urdf(folder, "<axis xyz=\"0 0.6 0.8\"/>", "<axis xyz=\"0 1.2 1.6\"/>");
  EXPECT_THAT(warnings_of(cell), HasSubstr("twin.urdf:26: joint l_slide: axis xyz '0 1.2 1.6' is "
                                           "not of length 1: only its direction is used"));
  const CellPtr built = build_or_fail(cell);
  EXPECT_TRUE(built->link(*built->find_link("t_l1")).axis.isApprox(Eigen::Vector3d(0, 0.6, 0.8)));
  const CellDescription rounded =
      with_urdf(folder, "<axis xyz=\"0 0.6 0.8\"/>", "<axis xyz=\"0 0.602 0.8\"/>");
  EXPECT_EQ(warnings_of(rounded), "");
}

TEST(Meshes, TooSmallForTheirUnitCauseAWarning) {
  const ScratchFolder folder;
  EXPECT_THAT(warnings_of(with_urdf(folder, "scale=\"0.5 0.5 2\"", "scale=\"0.001 0.001 0.001\"")),
              HasSubstr("probably a unit error (scale applied to a file already in meters?)"));
}

TEST(Shapes, OutsideCollisionElementsAreRejected) {
  const ScratchFolder folder;
  const std::string geometry = "<geometry><box size=\"1 1 1\"/></geometry>";
  EXPECT_THAT(problems_of(with_urdf(folder, "<link name=\"r1\"/>",
                                    "<link name=\"r1\">" + geometry + "</link>")),
              HasSubstr("link r1: <geometry> would be left out here: it must be in a <collision>"));
  EXPECT_THAT(
      problems_of(
          with_urdf(folder, kTurnLimit, kTurnLimit + ("<collision>" + geometry + "</collision>"))),
      HasSubstr("joint l_turn: <collision> would be left out here: it must be in a <link>"));
}

TEST(FixedJoints, MisspelledNameSuppressesFollowOnErrors) {
  const ScratchFolder folder;
  CellDescription cell = two_arms_description();
  cell.robots[0].srdf =
      folder.write("twin.srdf", file_with(data_file("two_arms.srdf"),
                                          "<joint name=\"l_turn\"/><joint name=\"l_slide\"/>",
                                          "<joint name=\"l_turn\"/>"));
  cell.robots[0].arms[0].home.clear();
  cell.robots[0].fixed = {{"l_slyde", 0.3}};
  EXPECT_EQ(problems_of(cell),
            "/robots/0/fixed/l_slyde | robot twin: fixed joint l_slyde is not in two_arms.urdf; "
            "did you mean l_slide?\n");
}

TEST(NamedStates, WithAnInvalidValueAreReportedOnce) {
  const ScratchFolder folder;
  CellDescription cell = two_arms_description();
  cell.robots[0].srdf = folder.write(
      "twin.srdf", file_with(data_file("two_arms.srdf"), "value=\"1.5\"", "value=\"x\""));
  cell.robots[0].arms[0].home.clear();
  cell.robots[0].arms[0].home_state = "out";
  EXPECT_EQ(without_lines(problems_of(cell)),
            "twin.srdf: group_state out of left_arm: joint l_turn | twin.srdf: group_state out of "
            "left_arm: joint l_turn: joint value is 'x', not a finite number\n");
}

TEST(CrossedLimits, SuppressProblemsOfHomesOutsideTheLimits) {
  const ScratchFolder folder;
  EXPECT_THAT(
      problems_of(with_urdf(folder, kTurnLimit,
                            "<limit lower=\"2\" upper=\"-2\" effort=\"50\" velocity=\"2\"/>")),
      AllOf(HasSubstr("limit lower 2 is above upper -2"), Not(HasSubstr("outside"))));
}

TEST(LimitsInTheCell, OfUnknownJointsSuggestAName) {
  CellDescription cell = two_arms_description();
  cell.robots[0].arms[0].limits["l_tern"].velocity = 1;
  cell.robots[0].arms[0].limits["r_bend"].velocity = 1;
  EXPECT_THAT(problems_of(cell),
              AllOf(HasSubstr("arm left has no joint l_tern to limit; did you mean l_turn?"),
                    HasSubstr("arm left has no joint r_bend to limit: it belongs to another arm")));
}

}  // namespace
}  // namespace armloom
