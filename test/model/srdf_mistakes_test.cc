#include <gmock/gmock.h>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::HasSubstr;

struct Mistake {
  const char* from;
  const char* to;
  const char* place;
  const char* sentence;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.from << " -> " << mistake.to;
}

CellDescription cell_with_srdf(const ScratchFolder& folder, const Mistake& mistake) {
  CellDescription description = two_arms_description();
  description.robots[0].srdf =
      folder.write("twin.srdf", file_with(data_file("two_arms.srdf"), mistake.from, mistake.to));
  return description;
}

class SrdfMistake : public testing::TestWithParam<Mistake> {};

TEST_P(SrdfMistake, InAnArmsDefinitionIsAProblem) {
  const ScratchFolder folder;
  EXPECT_THAT(
      without_lines(problems_of(cell_with_srdf(folder, GetParam()))),
      HasSubstr(std::string(GetParam().place) + " | " + without_lines(GetParam().sentence)));
}

INSTANTIATE_TEST_SUITE_P(
    All, SrdfMistake,
    testing::Values(
        Mistake{"<joint name=\"l_turn\"/>", "<joint name=\"l_torn\"/>", "/robots/0/arms/0/home",
                "arm left: home has 2 values, the group has 1 joints; give one value for each of "
                "l_slide"},
        Mistake{"tip_link=\"r_tip\"", "tip_link=\"r_top\"", "/robots/0/arms/1/group",
                "arm right: group 'right_arm' has no movable joint; groups with movable joints: "
                "both, gripper, left_arm"},
        Mistake{"tip_link=\"r_tip\"", "", "twin.srdf: group right_arm",
                "twin.srdf: group right_arm: chain tip_link is missing"},
        Mistake{"base_link=\"post\"", "base_link=\"l1\"", "twin.srdf: group right_arm",
                "twin.srdf: group right_arm: tip_link r_tip is not below base_link l1"},
        Mistake{"<group name=\"both\">", "<group name=\"left_arm\">", "twin.srdf: group left_arm",
                "twin.srdf: group left_arm: more than one group has this name"},
        Mistake{"group name=\"right_arm\"><",
                "group name=\"right_arm\"><group name=\"right_arm\"/><",
                "twin.srdf: group right_arm",
                "twin.srdf: group right_arm: group right_arm also contains this group: a cycle"},
        Mistake{"<enable_collisions link1=", "<enable_collision link1=", "twin.srdf: robot",
                "twin.srdf: robot: <enable_collision> is not known; did you mean "
                "<enable_collisions>?"},
        Mistake{"<joint name=\"l_turn\"/>", "<joint/>", "twin.srdf: group left_arm",
                "twin.srdf: group left_arm: joint name is missing"},
        Mistake{"<joint name=\"l_turn\"/>", "<Joint name=\"l_turn\"/>", "twin.srdf: group left_arm",
                "twin.srdf: group left_arm: <Joint> is not known; did you mean <joint>?"},
        Mistake{"<?xml version=\"1.0\"?>", "<!DOCTYPE robot>", "twin.srdf:1",
                "twin.srdf:1: a DOCTYPE or entity declaration is not allowed"}));

class SrdfOddity : public testing::TestWithParam<Mistake> {};

TEST_P(SrdfOddity, IsOnlyAWarning) {
  const ScratchFolder folder;
  EXPECT_THAT(without_lines(warnings_of(cell_with_srdf(folder, GetParam()))),
              testing::AllOf(HasSubstr(std::string(GetParam().place) + " | "),
                             HasSubstr(GetParam().sentence)));
}

INSTANTIATE_TEST_SUITE_P(
    Groups, SrdfOddity,
    testing::Values(Mistake{"<link name=\"l_finger1\"/>", "<link name=\"l_thumb\"/>",
                            "twin.srdf: group gripper",
                            "link l_thumb is not in two_arms.urdf; it is left out of the group"},
                    Mistake{"<group name=\"left_arm\"/>", "<group name=\"lefty\"/>",
                            "twin.srdf: group both", "group lefty does not exist"},
                    Mistake{"<group name=\"left_arm\"/>", "<group name=\"both\"/>",
                            "twin.srdf: group both", "a cycle"},
                    Mistake{"<link name=\"l_finger1\"/>", "<links name=\"l_finger1\"/>",
                            "twin.srdf: group gripper",
                            "<links> is not known; did you mean <link>?"},
                    Mistake{"<group name=\"gripper\">",
                            "<group name=\"both\"/><group name=\"gripper\">",
                            "twin.srdf: group both", "more than one group has this name"},
                    Mistake{"<group name=\"both\">", "<group>", "twin.srdf: group",
                            "group name is missing; no arm can be this group"}));

INSTANTIATE_TEST_SUITE_P(
    States, SrdfOddity,
    testing::Values(
        Mistake{"group_state name=\"out\" group=\"left_arm\"",
                "group_state name=\"out\" group=\"lefty\"", "twin.srdf: group_state out of lefty",
                "group lefty does not exist; the state is left out"},
        Mistake{"<joint name=\"l_turn\" value=\"1.5\"/>", "<joint name=\"l_torn\" value=\"1.5\"/>",
                "twin.srdf: group_state out of left_arm", "joint l_torn is not in two_arms.urdf"},
        Mistake{"<joint name=\"l_turn\" value=\"1.5\"/>", "",
                "twin.srdf: group_state out of left_arm", "joint l_turn has no value"},
        Mistake{"<joint name=\"l_turn\" value=\"1.5\"/>", "<joint name=\"r_spin\" value=\"1.5\"/>",
                "twin.srdf: group_state out of left_arm", "joint r_spin is not in the group"},
        Mistake{"<joint name=\"l_turn\" value=\"1.5\"/>",
                "<joint name=\"l_turn\" value=\"1.5\"/><joint name=\"l_turn\" value=\"1\"/>",
                "twin.srdf: group_state out of left_arm", "joint l_turn has more than one value"},
        Mistake{"value=\"1.5\"", "value=\"2.6\"", "twin.srdf: group_state out of left_arm",
                "joint l_turn is at 2.6, outside [-2, 2.5]"},
        Mistake{"value=\"1.5\"", "value=\"1.5 1.6\"",
                "twin.srdf: group_state out of left_arm: joint l_turn",
                "joint value is '1.5 1.6', not a finite number"}));

INSTANTIATE_TEST_SUITE_P(
    Others, SrdfOddity,
    testing::Values(
        Mistake{"type=\"fixed\"", "type=\"planar\"", "twin.srdf: virtual_joint",
                "it makes the robot's base planar, but here the base stays where the cell's "
                "\"base\" places it"},
        Mistake{"link1=\"r2\"", "link1=\"r9\"", "twin.srdf: disable_collisions",
                "1 of 1 name links that are not in two_arms.urdf (r9 at line 16); they are left "
                "out, and the intended links stay checked"},
        Mistake{"link1=\"r2\"", "", "twin.srdf: disable_collisions",
                "disable_collisions link1 is missing; the links of the pair stay checked"},
        Mistake{"link1=\"r2\"", "link1=\"r1\"", "twin.srdf: disable_collisions",
                "link1 and link2 are the same link"},
        Mistake{"link=\"l_hand\"", "link=\"l_foot\"", "twin.srdf: disable_default_collisions",
                "(l_foot at line 14)"},
        Mistake{"passive_joint name=\"l_grip_mirror\"", "passive_joint name=\"x\"",
                "twin.srdf: passive_joint", "joint x is not in two_arms.urdf"},
        Mistake{"passive_joint name=\"l_grip_mirror\"", "passive_joint name=\"l_turn\"",
                "twin.srdf: passive_joint",
                "joint l_turn is passive (the robot has no motor for it), but in the group of arm "
                "left: it is checked as if jobs moved it, which the robot cannot do; take it out "
                "of group left_arm, or hold it with \"fixed\""},
        Mistake{"<robot name=\"two_arms\">", "<robot name=\"three_arms\">", "twin.srdf: robot",
                "the SRDF is for robot three_arms, but two_arms.urdf for robot two_arms; its "
                "groups and disabled pairs of links are used all the same"}));

TEST(SrdfStates, UsedAsHomeMustBeValid) {
  const ScratchFolder folder;
  CellDescription cell = cell_with_srdf(folder, {"value=\"1.5\"", "value=\"2.6\"", "", ""});
  cell.robots[0].arms[0].home.clear();
  cell.robots[0].arms[0].home_state = "out";
  EXPECT_EQ(
      problems_of(cell),
      "twin.srdf:8: group_state out of left_arm | twin.srdf:8: group_state out of left_arm: joint "
      "l_turn is at 2.6, outside [-2, 2.5]\n");
}

TEST(SrdfGroups, CycleIsReported) {
  const ScratchFolder folder;
  CellDescription cell = two_arms_description();
  cell.robots[0].srdf = folder.write("twin.srdf",
                                     "<robot name='r'><group name='a'><group "
                                     "name='b'/></group><group name='b'><group name='c'/></group>"
                                     "<group name='c'><group name='a'/></group></robot>");
  cell.robots[0].arms[0].group = "a";
  EXPECT_THAT(problems_of(cell), HasSubstr("twin.srdf:1: group c | twin.srdf:1: group c: group a "
                                           "also contains this group: a cycle"));
}

TEST(SrdfGroups, MayReferToLaterGroups) {
  CellDescription cell = two_arms_description();
  cell.robots[0].arms.resize(1);
  cell.robots[0].arms[0] = {"all", "both", {}, {}, {}};
  EXPECT_EQ(build_or_fail(cell)->arms[0].joints.size(), 5u);
}

TEST(SrdfFile, MissingFileIsAProblem) {
  CellDescription cell = two_arms_description();
  cell.robots[0].srdf = data_file("missing.srdf");
  EXPECT_THAT(problems_of(cell), testing::StartsWith("/robots/0/srdf | robot twin: cannot read"));
  cell.robots[0].srdf.clear();
  EXPECT_THAT(problems_of(cell),
              HasSubstr("/robots/0/arms/0/group | arm left: group left_arm needs an SRDF"));
}

}  // namespace
}  // namespace armloom
