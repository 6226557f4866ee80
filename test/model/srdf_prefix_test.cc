// A URDF whose names have a prefix, with MoveIt's files whose names lack it.
#include <gmock/gmock.h>

#include <regex>

#include "core/model/xml/text_file.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class SrdfPrefix : public testing::Test {
 protected:
  // Returns the URDF of two_arms with a prefix before each name of a link or joint.
  static std::string prefixed(const std::string& urdf, const std::string& prefix) {
    const std::regex name(
        R"re((<link name="|<joint name="|<parent link="|<child link="|joint="))re");
    return std::regex_replace(urdf, name, "$1" + prefix);
  }
  static std::string text_of_file(const std::string& name) {
    return file_with(data_file(name), "<robot name", "<robot name");
  }
  CellDescription cell_with(const std::string& urdf) const {
    CellDescription cell = two_arms_description();
    cell.robots[0].urdf = folder_.write("ur.urdf", urdf);
    return cell;
  }

  ScratchFolder folder_;
  const std::string urdf_ = text_of_file("two_arms.urdf");
};

TEST_F(SrdfPrefix, IsReportedWithTheLineIfTheSrdfLacksIt) {
  const CellDescription cell = cell_with(prefixed(urdf_, "ur_"));
  EXPECT_EQ(without_lines(problems_of(cell)),
            "two_arms.srdf: robot | two_arms.srdf: robot: all 14 names of joints and links in "
            "two_arms.srdf exist in ur.urdf with ur_ before them: add to the robot "
            "\"srdf_prefix\": \"ur_\" (armloom import: --srdf-prefix ur_)\n");
  CellDescription other = cell;
  other.robots[0].srdf_prefix = "us_";
  EXPECT_THAT(problems_of(other), HasSubstr("\"srdf_prefix\": \"ur_\""));
}

TEST_F(SrdfPrefix, AppliesToEveryNameOfALinkOrJoint) {
  const CellPtr plain = build_or_fail(two_arms_description());
  CellDescription description = cell_with(prefixed(urdf_, "ur_"));
  description.robots[0].srdf_prefix = "ur_";
  const CellPtr cell = build_or_fail(description);
  EXPECT_EQ(cell->joint(cell->arms[0].joints[0]).name, "t_ur_l_slide");
  ASSERT_EQ(cell->arms.size(), plain->arms.size());
  for (std::size_t a = 0; a < plain->arms.size(); ++a) {
    EXPECT_EQ(cell->arms[a].joints, plain->arms[a].joints);
    EXPECT_EQ(cell->arms[a].gripper_joints, plain->arms[a].gripper_joints);
    EXPECT_EQ(cell->arms[a].named_states, plain->arms[a].named_states);
  }
  EXPECT_EQ(cell->allowed.link_pairs, plain->allowed.link_pairs);
  EXPECT_EQ(cell->allowed.claimed_pairs.size(), plain->allowed.claimed_pairs.size());
  EXPECT_EQ(warnings_of(description), warnings_of(two_arms_description()));
}

TEST_F(SrdfPrefix, IsAmbiguousIfTheUrdfHasTheRobotTwice) {
  const auto body = [&](const std::string& prefix) {
    const std::string text = prefixed(urdf_, prefix);
    const std::size_t begin = text.find("<link");
    return text.substr(begin, text.find("</robot>") - begin);
  };
  std::string both = R"(<robot name="two_arms"><link name="floor"/>)";
  for (const std::string side : {"left_", "right_"})
    both += body(side) + "<joint name='" + side + "mount' type='fixed'><parent link='floor'/>" +
            "<child link='" + side + "base'/></joint>";
  EXPECT_THAT(problems_of(cell_with(both + "</robot>")),
              AllOf(HasSubstr("exist in ur.urdf with left_ and with right_ before them"),
                    HasSubstr("write one file for all of them")));
}

TEST_F(SrdfPrefix, IsReportedIfOnlyTheSrdfHasIt) {
  CellDescription cell = cell_with(urdf_);
  const std::regex name(R"re(((joint|link) name="|link[12]?="|_link=")(?!world))re");
  cell.robots[0].srdf =
      folder_.write("ur.srdf", std::regex_replace(text_of_file("two_arms.srdf"), name, "$1ur_"));
  EXPECT_THAT(problems_of(cell), AllOf(HasSubstr("exist in ur.urdf without ur_ before them"),
                                       HasSubstr("sed 's/\"ur_/\"/g' ur.srdf")));
}

TEST_F(SrdfPrefix, IsNotGuessedForAnotherRobot) {
  CellDescription cell = two_pandas_description();
  cell.robots[0].srdf = model_file("ur5e.srdf");
  EXPECT_THAT(problems_of(cell), Not(HasSubstr("before them")));
}

TEST_F(SrdfPrefix, OfJointLimitsIsSeparate) {
  CellDescription cell = cell_with(prefixed(urdf_, "ur_"));
  cell.robots[0].srdf_prefix = "ur_";
  cell.robots[0].joint_limits = folder_.write("joint_limits.yaml",
                                              "joint_limits:\n"
                                              "  l_turn: {max_velocity: 1}\n"
                                              "  r_spin: {max_velocity: 1}\n");
  EXPECT_THAT(warnings_of(cell),
              HasSubstr("none of its limits apply: all 2 names of joints and links in "
                        "joint_limits.yaml exist in ur.urdf with ur_ before them: add to the robot "
                        "\"joint_limits_prefix\": \"ur_\""));
  cell.robots[0].joint_limits_prefix = "ur_";
  EXPECT_EQ(joint_of(*build_or_fail(cell), "t_ur_l_turn").velocity_max, 1.0);
  EXPECT_THAT(warnings_of(cell), Not(HasSubstr("joint_limits")));
}

}  // namespace
}  // namespace armloom
