#include <gmock/gmock.h>

#include "test/model/urdf_text.h"

namespace armloom {
namespace {

using testing::HasSubstr;

TEST(UrdfText, InvalidUtf8IsRejectedWithItsLine) {
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

TEST(UrdfLimits, InvalidLimitsSuggestCellFileLimits) {
  struct Fault {
    const char* from;
    const char* to;
    const char* told;
    const char* line;
  };
  for (const Fault& fault :
       {Fault{"lower=\"-2\"", "lower=\"-2 rad\"", "limit lower is '-2 rad'", "\"lower_rad\": -1"},
        Fault{"velocity=\"2\"", "velocity=\"-2\"", "limit velocity is -2", "\"velocity_rad_s\": 1"},
        Fault{"lower=\"-2\" upper=\"2.5\"", "lower=\"2.6\" upper=\"2.5\"",
              "limit lower 2.6 is above upper 2.5", "\"lower_rad\": -1, \"upper_rad\": 1"}}) {
    const ScratchFolder folder;
    CellDescription cell =
        cell_with_urdf(folder, file_with(data_file("two_arms.urdf"), fault.from, fault.to));
    const std::string problems = problems_of(cell);
    EXPECT_THAT(problems, HasSubstr(std::string("twin.urdf:30: joint l_turn: ") + fault.told));
    EXPECT_THAT(problems,
                HasSubstr("add to the arm \"limits\": {\"l_turn\": {" + std::string(fault.line)));
    EXPECT_THAT(problems, HasSubstr("gives no usable limit of "));
    cell.robots[0].arms[0].limits["l_turn"] = {.lower = -1, .upper = 1, .velocity = 1};
    EXPECT_THAT(warnings_of(cell), HasSubstr(fault.told));
  }
}

TEST(UrdfFile, NonRobotFilesAreRejected) {
  const ScratchFolder folder;
  EXPECT_THAT(problems_of(cell_with_urdf(folder, "<sdf/>")),
              HasSubstr("the root element is <sdf>, not <robot>"));
  EXPECT_THAT(problems_of(cell_with_urdf(folder, "")), HasSubstr("malformed"));
  EXPECT_THAT(problems_of(cell_with_urdf(folder, robot_of(""))),
              HasSubstr("twin.urdf: robot: there are no links"));
  EXPECT_THAT(problems_of(cell_with_urdf(folder, std::string("<robot name='r'/>\0", 18))),
              HasSubstr("zero byte"));
}

TEST(UrdfFile, RejectsTooDeepNesting) {
  const ScratchFolder folder;
  std::string open, close;
  for (int i = 0; i < 100'000; ++i) open += "<a>", close += "</a>";
  EXPECT_THAT(problems_of(cell_with_urdf(folder, robot_of(open + close))),
              HasSubstr("nested too deeply"));
}

TEST(UrdfFile, RejectsFilesOver16MebibytesOr1000Links) {
  const ScratchFolder folder;
  EXPECT_THAT(problems_of(cell_with_urdf(folder, std::string((16u << 20) + 1, ' '))),
              HasSubstr("longer than 16777216 bytes"));
  std::string links;
  for (int i = 0; i < 1001; ++i) links += "<link name='l" + std::to_string(i) + "'/>";
  EXPECT_THAT(problems_of(cell_with_urdf(folder, robot_of(links))),
              HasSubstr("1001 links, at most 1000"));
}

TEST(UrdfFile, RejectsMissingAndNonRegularFiles) {
  CellDescription cell = two_arms_description();
  cell.robots[0].urdf = data_file("missing.urdf");
  EXPECT_THAT(problems_of(cell), testing::StartsWith("/robots/0/urdf | robot twin: cannot read"));
  cell.robots[0].urdf = data_file("");
  EXPECT_THAT(problems_of(cell), HasSubstr("it is not a regular file"));
  cell.robots[0].urdf = "/dev/zero";
  EXPECT_THAT(problems_of(cell), HasSubstr("it is not a regular file"));
}

TEST(UrdfFile, ReportsAllMistakesOncePerFile) {
  const ScratchFolder folder;
  CellDescription cell = cell_with_urdf(
      folder,
      robot_of("<link name='a'><collision><geometry><capsule/></geometry></collision></link>"
               "<link name='b'><collision><geometry><box/></geometry></collision></link>"
               "<joint name='j' type='revolute'><parent link='a'/><child link='c'/></joint>"));
  const std::string once = problems_of(cell);
  EXPECT_THAT(once, HasSubstr("<capsule>"));
  EXPECT_THAT(once, HasSubstr("box size is missing"));
  EXPECT_THAT(once, HasSubstr("child link c does not exist"));
  cell.robots.push_back(cell.robots[0]);
  cell.robots[1].name = "second";
  cell.robots[1].prefix = "s_";
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
  EXPECT_EQ(cell.error().size(), 102u);  // with the multiple roots, and the number of the rest
  EXPECT_THAT(cell.error().back().detail, HasSubstr("50 more problems"));
}

}  // namespace
}  // namespace armloom
