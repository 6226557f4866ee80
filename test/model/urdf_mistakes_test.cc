#include <gmock/gmock.h>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::HasSubstr;

CellDescription cell_with_urdf(const ScratchFolder& folder, const std::string& text) {
  CellDescription cell = two_arms_description();
  cell.robots[0].urdf = folder.write("twin.urdf", text);
  return cell;
}

TEST(UrdfText, ThatIsNotUtf8IsRefusedWithItsLine) {
  for (const char* bad : {"\xff", "\xc3(", "\xed\xa0\x80", "\xc0\xaf", "\xe2\x82"}) {
    const ScratchFolder folder;
    const auto cell = build_cell(cell_with_urdf(
        folder,
        "<robot name='r'>\n<!-- \xc3\xbc \xe2\x82\xac -->\n<link name='" + std::string(bad)));
    ASSERT_FALSE(cell.has_value());
    EXPECT_EQ(cell.error()[0].slug, "not-utf-8");
    EXPECT_THAT(cell.error()[0].pointer, testing::EndsWith("twin.urdf:3"));
    EXPECT_THAT(cell.error()[0].detail, HasSubstr("0x"));
  }
}

std::string robot_of(const std::string& body) { return "<robot name='r'>" + body + "</robot>"; }

// One mistake, made by replacing a piece of two_arms.urdf: where it must be found and what is said.
struct Mistake {
  const char* from;
  const char* to;
  const char* place;
  const char* sentence;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.from << " -> " << mistake.to;
}

class UrdfMistake : public testing::TestWithParam<Mistake> {};

TEST_P(UrdfMistake, IsTheOnlyProblemAndNamedByPlaceAndValue) {
  const Mistake& mistake = GetParam();
  const ScratchFolder folder;
  const auto cell = build_cell(
      cell_with_urdf(folder, file_with(data_file("two_arms.urdf"), mistake.from, mistake.to)));
  ASSERT_FALSE(cell.has_value()) << mistake.to << " was accepted";
  ASSERT_EQ(cell.error().size(), 1u) << cell.error()[0].detail << "\n"
                                     << cell.error().back().detail;
  EXPECT_EQ(cell.error()[0].pointer, mistake.place);
  EXPECT_THAT(cell.error()[0].detail, HasSubstr(mistake.sentence));
}

INSTANTIATE_TEST_SUITE_P(
    Numbers, UrdfMistake,
    testing::Values(
        Mistake{"0.1 -0.2 0.3", "0.1 nan 0.3", "twin.urdf: link post",
                "origin rpy is '0.1 nan 0.3', not 3 finite numbers"},
        Mistake{"0.4 0.6 0.1\"/></geometry></collision>", "0.4 0.6\"/></geometry></collision>",
                "twin.urdf: link base", "box size is '0.4 0.6', not 3"},
        Mistake{"0.4 0.6 0.1\"/></geometry></collision>", "0.4 -0.6 0.1\"/></geometry></collision>",
                "twin.urdf: link base", "box size is -0.6 m, it must be greater than 0"},
        Mistake{"size=\"0.4 0.6 0.1\"/></geometry><material",
                "size=\"0.4 0x10 0.1\"/></geometry><material", "twin.urdf: link base",
                "box size is '0.4 0x10 0.1'"},
        Mistake{"radius=\"0.08\"", "radius=\"0\"", "twin.urdf: link post",
                "cylinder radius is 0 m"},
        Mistake{"length=\"1\"", "length=\"1e999\"", "twin.urdf: link post",
                "cylinder length is '1e999', not a finite number"},
        Mistake{"length=\"1\"", "len=\"1\"", "twin.urdf: link post", "cylinder length is missing"},
        Mistake{"sphere radius=\"0.09\"", "sphere radius=\"0x10\"", "twin.urdf: link post",
                "sphere radius is '0x10'"},
        Mistake{"scale=\"0.5 0.5 2\"", "scale=\"0.5 0 2\"", "twin.urdf: link l2",
                "mesh scale holds a 0"},
        Mistake{"scale=\"0.5 0.5 2\"", "scale=\"0.5\"", "twin.urdf: link l2",
                "mesh scale is '0.5', not 3"},
        Mistake{"lower=\"-2\"", "lower=\"-2 rad\"", "twin.urdf: joint l_turn",
                "limit lower is '-2 rad'"},
        Mistake{"multiplier=\"2\"", "multiplier=\"two\"", "twin.urdf: joint l_grip_mirror",
                "mimic multiplier is 'two'"},
        Mistake{"offset=\"0.001\"", "offset=\"inf\"", "twin.urdf: joint l_grip_mirror",
                "mimic offset is 'inf'"},
        Mistake{"xyz=\"0 0.6 0.8\"", "xyz=\"0 0 0\"", "twin.urdf: joint l_slide",
                "axis xyz '0 0 0' has no direction"},
        Mistake{"xyz=\"0 0.6 0.8\"", "xyz=\"0 1\"", "twin.urdf: joint l_slide",
                "axis xyz is '0 1'"}));

INSTANTIATE_TEST_SUITE_P(
    Shapes, UrdfMistake,
    testing::Values(Mistake{"<sphere radius=\"0.09\"/>", "<capsule radius=\"0.09\" length=\"1\"/>",
                            "twin.urdf: link post",
                            "collision geometry <capsule> is not supported"},
                    Mistake{"<sphere radius=\"0.09\"/>", "", "twin.urdf: link post",
                            "collision geometry is empty"},
                    Mistake{"<sphere radius=\"0.09\"/>",
                            "<sphere radius=\"0.09\"/><sphere radius=\"1\"/>",
                            "twin.urdf: link post", "more than one shape"},
                    Mistake{"<geometry><sphere radius=\"0.09\"/></geometry>", "",
                            "twin.urdf: link post", "<geometry> is missing"},
                    Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"><colision/></link>",
                            "twin.urdf: link r1", "<colision> is not known here"},
                    Mistake{"package://shapes/tetra.stl", "package://shapes/../two_arms.urdf",
                            "twin.urdf: link l2", "leaves its folder"},
                    Mistake{"package://shapes/tetra.stl", "package://others/tetra.stl",
                            "twin.urdf: link l2", "package 'others'"},
                    Mistake{"package://shapes/tetra.stl", "package://shapes/octa.stl",
                            "twin.urdf: link l2", "does not exist"},
                    Mistake{"filename=\"package://shapes/tetra.stl\"", "", "twin.urdf: link l2",
                            "mesh filename is missing"}));

INSTANTIATE_TEST_SUITE_P(
    Joints, UrdfMistake,
    testing::Values(Mistake{"effort=\"50\" velocity=\"2\"", "effort=\"50\"",
                            "twin.urdf: joint l_turn",
                            "twin.urdf: joint l_turn: limit velocity is missing"},
                    Mistake{"effort=\"50\" velocity=\"2\"", "velocity=\"2\"",
                            "twin.urdf: joint l_turn", "limit effort is missing"},
                    Mistake{"velocity=\"2\"", "velocity=\"0\"", "twin.urdf: joint l_turn",
                            "limit velocity is 0, it must be greater than 0"},
                    Mistake{"velocity=\"2\"", "velocity=\"-2\"", "twin.urdf: joint l_turn",
                            "limit velocity is -2"},
                    Mistake{"<limit effort=\"50\" velocity=\"3\"/>", "", "twin.urdf: joint r_spin",
                            "<limit> is missing"},
                    Mistake{"lower=\"-1\" upper=\"1\"", "upper=\"1\"", "twin.urdf: joint r_last",
                            "limit lower is missing"},
                    Mistake{"lower=\"-2\" upper=\"2.5\"", "lower=\"2.6\" upper=\"2.5\"",
                            "twin.urdf: joint l_turn", "limit lower 2.6 is above upper 2.5"},
                    Mistake{"\"r_spin\" type=\"continuous\"", "\"r_spin\" type=\"floating\"",
                            "twin.urdf: joint r_spin", "joint type floating is not supported"},
                    Mistake{"\"r_spin\" type=\"continuous\"", "\"r_spin\" type=\"planar\"",
                            "twin.urdf: joint r_spin", "joint type planar is not supported"},
                    Mistake{"\"r_spin\" type=\"continuous\"", "\"r_spin\" type=\"hinge\"",
                            "twin.urdf: joint r_spin", "joint type 'hinge' is not known"},
                    Mistake{"\"r_spin\" type=\"continuous\"", "\"r_spin\"",
                            "twin.urdf: joint r_spin", "joint type is missing"},
                    Mistake{"mimic joint=\"l_grip\"", "mimic joint=\"l_gripp\"",
                            "twin.urdf: joint l_grip_mirror", "mimic joint l_gripp does not exist"},
                    Mistake{"mimic joint=\"l_grip\"", "mimic joint=\"r_follow\"",
                            "twin.urdf: joint l_grip_mirror",
                            "mimic joint r_follow is a mimic itself"},
                    Mistake{"mimic joint=\"l_grip\"", "mimic joint=\"l_grip_mirror\"",
                            "twin.urdf: joint l_grip_mirror", "the joint mimics itself"},
                    Mistake{"mimic joint=\"l_grip\"", "mimic joint=\"l_wrist\"",
                            "twin.urdf: joint l_grip_mirror", "mimic joint l_wrist is fixed"},
                    Mistake{"mimic joint=\"l_grip\"", "mimic", "twin.urdf: joint l_grip_mirror",
                            "mimic joint is missing"}));

INSTANTIATE_TEST_SUITE_P(
    Tree, UrdfMistake,
    testing::Values(
        Mistake{"<link name=\"r2\"/>", "<link name=\"r2\"/><link name=\"r2\"/>",
                "twin.urdf: link r2", "more than one link has this name"},
        Mistake{"\"r_last\" type", "\"r_bend\" type", "twin.urdf: joint r_bend",
                "more than one joint has this name"},
        Mistake{"<link name=\"r2\"/>", "<link/><link name=\"r2\"/>", "twin.urdf: link at line 47",
                "link name is missing"},
        Mistake{"<child link=\"r_tip\"/>", "<child link=\"r_top\"/>", "twin.urdf: joint r_last",
                "child link r_top does not exist"},
        Mistake{"<child link=\"r_tip\"/>", "", "twin.urdf: joint r_last", "<child> is missing"},
        Mistake{"<child link=\"r_tip\"/>", "<child link=\"r2\"/>", "twin.urdf: joint r_last",
                "child link r2 already hangs on joint r_bend"},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"/><link name=\"stray\"/>",
                "twin.urdf: robot", "more than one root link: base, stray"},
        Mistake{"<parent link=\"post\"/><child link=\"r1\"/>",
                "<parent link=\"r_tip\"/><child link=\"r1\"/>", "twin.urdf: robot",
                "links hang in a loop and not below a root: r1, r2, r3, r_tip"},
        Mistake{"<robot name=\"two_arms\"", "<robot", "twin.urdf: robot",
                "robot name is missing"}));

INSTANTIATE_TEST_SUITE_P(
    Document, UrdfMistake,
    testing::Values(
        Mistake{"<?xml version=\"1.0\"?>", "<!DOCTYPE robot>", "twin.urdf:1",
                "DOCTYPE or entity declaration is not allowed"},
        Mistake{"<?xml version=\"1.0\"?>", "<!DOCTYPE robot [<!ENTITY a \"b\">]>", "twin.urdf:1",
                "DOCTYPE"},
        Mistake{"<link name=\"r1\"/>", "<link name=\"r1\"/><xacro:property name=\"x\"/>",
                "twin.urdf:46", "the file is xacro"},
        Mistake{"</robot>", "", "twin.urdf:5", "the XML is malformed"},
        Mistake{"</robot>", "</robot><robot/>", "twin.urdf:67", "more than one XML element"}));

TEST(UrdfFile, OtherThanARobotIsRefused) {
  const ScratchFolder folder;
  EXPECT_THAT(problems_of(cell_with_urdf(folder, "<sdf/>")),
              HasSubstr("the root element is <sdf>, not <robot>"));
  EXPECT_THAT(problems_of(cell_with_urdf(folder, "")), HasSubstr("malformed"));
  EXPECT_THAT(problems_of(cell_with_urdf(folder, robot_of(""))),
              HasSubstr("twin.urdf: robot: there are no links"));
  EXPECT_THAT(problems_of(cell_with_urdf(folder, std::string("<robot name='r'/>\0", 18))),
              HasSubstr("zero byte"));
}

TEST(UrdfFile, IsRefusedWhenNestedTooDeeply) {
  const ScratchFolder folder;
  std::string open, close;
  for (int i = 0; i < 100'000; ++i) open += "<a>", close += "</a>";
  EXPECT_THAT(problems_of(cell_with_urdf(folder, robot_of(open + close))),
              HasSubstr("nested too deeply"));
}

TEST(UrdfFile, IsRefusedWhenLongerThanSixteenMebibytesOrOfTooManyLinks) {
  const ScratchFolder folder;
  EXPECT_THAT(problems_of(cell_with_urdf(folder, std::string((16u << 20) + 1, ' '))),
              HasSubstr("longer than 16777216 bytes"));
  std::string links;
  for (int i = 0; i < 1001; ++i) links += "<link name='l" + std::to_string(i) + "'/>";
  EXPECT_THAT(problems_of(cell_with_urdf(folder, robot_of(links))),
              HasSubstr("1001 links, at most 1000"));
}

TEST(UrdfFile, IsRefusedWhenMissingOrNoFile) {
  CellDescription cell = two_arms_description();
  cell.robots[0].urdf = data_file("missing.urdf");
  EXPECT_THAT(problems_of(cell), testing::StartsWith("/robots/0/urdf | robot twin: cannot read"));
  cell.robots[0].urdf = data_file("");
  EXPECT_THAT(problems_of(cell), HasSubstr("it is not a regular file"));
  cell.robots[0].urdf = "/dev/zero";
  EXPECT_THAT(problems_of(cell), HasSubstr("it is not a regular file"));
}

TEST(UrdfFile, TellsEveryMistakeAtOnceAndTheSameFileOnce) {
  const ScratchFolder folder;
  CellDescription cell = cell_with_urdf(
      folder,
      robot_of("<link name='a'><collision><geometry><capsule/></geometry></collision></link>"
               "<link name='b'><inertial><mass value='heavy'/></inertial></link>"
               "<joint name='j' type='revolute'><parent link='a'/><child link='c'/></joint>"));
  const std::string once = problems_of(cell);
  EXPECT_THAT(once, HasSubstr("<capsule>"));
  EXPECT_THAT(once, HasSubstr("mass value is 'heavy'"));
  EXPECT_THAT(once, HasSubstr("<limit> is missing"));
  EXPECT_THAT(once, HasSubstr("child link c does not exist"));
  cell.robots.push_back(cell.robots[0]);
  cell.robots[1].name = "second";
  cell.robots[1].arms.clear();
  EXPECT_EQ(problems_of(cell), once);
}

TEST(UrdfFile, KeepsAHundredProblemsAndCountsTheRest) {
  const ScratchFolder folder;
  std::string links;
  for (int i = 0; i < 150; ++i)
    links += "<link name='l" + std::to_string(i) + "'><collision/></link>";
  const auto cell = build_cell(cell_with_urdf(folder, robot_of(links)));
  ASSERT_FALSE(cell.has_value());
  EXPECT_EQ(cell.error().size(), 101u);
  EXPECT_THAT(cell.error().back().detail,
              HasSubstr("51 more problems"));  // 50 links and the many roots
}

}  // namespace
}  // namespace armloom
