#include <gmock/gmock.h>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::HasSubstr;

// One mistake, made by replacing a piece of two_arms.srdf: where it must be found and what is said.
struct Mistake {
  const char* from;
  const char* to;
  const char* place;
  const char* sentence;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.from << " -> " << mistake.to;
}

class SrdfMistake : public testing::TestWithParam<Mistake> {};

TEST_P(SrdfMistake, IsTheOnlyProblemAndNamedByPlaceAndValue) {
  const Mistake& mistake = GetParam();
  const ScratchFolder folder;
  CellDescription description = two_arms_description();
  description.robots[0].srdf =
      folder.write("twin.srdf", file_with(data_file("two_arms.srdf"), mistake.from, mistake.to));
  const auto cell = build_cell(description);
  ASSERT_FALSE(cell.has_value()) << mistake.to << " was accepted";
  ASSERT_EQ(cell.error().size(), 1u) << cell.error()[0].detail << "\n"
                                     << cell.error().back().detail;
  EXPECT_EQ(cell.error()[0].pointer, mistake.place);
  EXPECT_THAT(cell.error()[0].detail, HasSubstr(mistake.sentence));
}

INSTANTIATE_TEST_SUITE_P(
    Groups, SrdfMistake,
    testing::Values(Mistake{"<joint name=\"l_turn\"/>", "<joint name=\"l_torn\"/>",
                            "twin.srdf: group left_arm", "joint l_torn is not in two_arms.urdf"},
                    Mistake{"<link name=\"l_finger1\"/>", "<link name=\"l_thumb\"/>",
                            "twin.srdf: group gripper", "link l_thumb is not in two_arms.urdf"},
                    Mistake{"tip_link=\"r_tip\"", "tip_link=\"r_top\"",
                            "twin.srdf: group right_arm",
                            "chain tip_link r_top is not in two_arms.urdf"},
                    Mistake{"tip_link=\"r_tip\"", "", "twin.srdf: group right_arm",
                            "chain tip_link is missing"},
                    Mistake{"base_link=\"post\"", "base_link=\"l1\"", "twin.srdf: group right_arm",
                            "tip_link r_tip is not below base_link l1"},
                    Mistake{"<group name=\"left_arm\"/>", "<group name=\"lefty\"/>",
                            "twin.srdf: group both", "group lefty does not exist"},
                    Mistake{"<group name=\"left_arm\"/>", "<group name=\"both\"/>",
                            "twin.srdf: group both", "a cycle"},
                    Mistake{"<link name=\"l_finger1\"/>", "<links name=\"l_finger1\"/>",
                            "twin.srdf: group gripper", "<links> is not known here"},
                    Mistake{"<group name=\"gripper\">",
                            "<group name=\"both\"/><group name=\"gripper\">",
                            "twin.srdf: group both", "more than one group has this name"},
                    Mistake{"<group name=\"both\">", "<group>", "twin.srdf: group at line 4",
                            "group name is missing"}));

INSTANTIATE_TEST_SUITE_P(
    States, SrdfMistake,
    testing::Values(
        Mistake{"group_state name=\"out\" group=\"left_arm\"",
                "group_state name=\"out\" group=\"lefty\"", "twin.srdf: group_state out of lefty",
                "group lefty does not exist"},
        Mistake{"<joint name=\"l_turn\" value=\"1.5\"/>", "<joint name=\"l_torn\" value=\"1.5\"/>",
                "twin.srdf: group_state out of left_arm", "joint l_torn is not in two_arms.urdf"},
        Mistake{"<joint name=\"l_turn\" value=\"1.5\"/>", "",
                "twin.srdf: group_state out of left_arm", "joint l_turn has no value"},
        Mistake{"<joint name=\"l_turn\" value=\"1.5\"/>", "<joint name=\"r_spin\" value=\"1.5\"/>",
                "twin.srdf: group_state out of left_arm", "joint r_spin is not in the group"},
        Mistake{"value=\"1.5\"", "value=\"2.6\"", "twin.srdf: group_state out of left_arm",
                "joint l_turn is at 2.6, outside [-2, 2.5]"},
        Mistake{"value=\"1.5\"", "value=\"1.5 1.6\"",
                "twin.srdf: group_state out of left_arm: joint l_turn",
                "joint value is '1.5 1.6', not a finite number"},
        Mistake{"value=\"0.04\"", "value=\"nan\"",
                "twin.srdf: group_state open of gripper: joint l_grip", "joint value is 'nan'"}));

INSTANTIATE_TEST_SUITE_P(
    Pairs, SrdfMistake,
    testing::Values(
        Mistake{"link1=\"r2\"", "link1=\"r9\"", "twin.srdf: disable_collisions at line 16",
                "link r9 is not in two_arms.urdf"},
        Mistake{"link1=\"r2\"", "", "twin.srdf: disable_collisions at line 16",
                "disable_collisions link1 is missing"},
        Mistake{"link1=\"r2\"", "link1=\"r1\"", "twin.srdf: disable_collisions at line 16",
                "link1 and link2 are the same link"},
        Mistake{"link=\"l_hand\"", "link=\"l_foot\"",
                "twin.srdf: disable_default_collisions at line 14",
                "link l_foot is not in two_arms.urdf"},
        Mistake{"passive_joint name=\"l_grip_mirror\"", "passive_joint name=\"x\"",
                "twin.srdf: passive_joint at line 13", "joint x is not in two_arms.urdf"},
        Mistake{"<?xml version=\"1.0\"?>", "<!DOCTYPE robot>", "twin.srdf:1", "DOCTYPE"}));

TEST(SrdfGroups, ThatHoldEachOtherAreToldAsACycle) {
  const ScratchFolder folder;
  CellDescription cell = two_arms_description();
  cell.robots[0].srdf = folder.write("twin.srdf",
                                     "<robot name='r'><group name='a'><group "
                                     "name='b'/></group><group name='b'><group name='c'/></group>"
                                     "<group name='c'><group name='a'/></group></robot>");
  EXPECT_THAT(
      problems_of(cell),
      HasSubstr("twin.srdf: group c | twin.srdf: group c: group a holds this group too: a cycle"));
}

TEST(SrdfGroups, MayReferToLaterGroups) {
  CellDescription cell = two_arms_description();
  cell.robots[0].arms.resize(1);
  cell.robots[0].arms[0] = {"all", "both", {}, {}};
  EXPECT_EQ(build_or_fail(cell)->arms[0].joints.size(), 5u);
}

TEST(SrdfFile, ThatIsMissingIsAProblemAndNoReasonToGuess) {
  CellDescription cell = two_arms_description();
  cell.robots[0].srdf = data_file("missing.srdf");
  EXPECT_THAT(problems_of(cell), testing::StartsWith("/robots/0/srdf | robot twin: cannot read"));
  cell.robots[0].srdf.clear();
  EXPECT_THAT(problems_of(cell),
              HasSubstr("/robots/0/arms/0/group | arm left: group left_arm needs an SRDF"));
}

}  // namespace
}  // namespace armloom
