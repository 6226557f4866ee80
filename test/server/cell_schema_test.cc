#include "server/codec/cell_schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/nearest_name.h"
#include "server/codec/cell_codec.h"
#include "server/codec/cell_format.h"
#include "server/codec/commented_json.h"
#include "server/codec/json_text.h"
#include "server/codec/schema_reference.h"
#include "server/recording/recording.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path kConfig = fs::path(source_dir()) / "config";

Schema written(const CellDescription& cell) {
  JsonWriter out;
  cell_format().write(out, cell);
  return as_json(out);
}

CellDescription read(const std::string& text) {
  auto cell = read_cell_text(text, kConfig);
  EXPECT_TRUE(cell) << cell.error().front().pointer << cell.error().front().detail;
  return cell.value_or(CellDescription{});
}

TEST(CellSchema, MatchesTheFileInConfig) {
  EXPECT_EQ(read_text_file(kConfig / "cell.schema.json").value(), cell_schema_text())
      << "build/armloom schema > config/cell.schema.json";
}

TEST(CellSchema, MatchesTheReferenceInConfig) {
  EXPECT_EQ(read_text_file(kConfig / "README.md").value(), cell_reference_text())
      << "build/armloom schema --markdown > config/README.md";
}

TEST(CellSchema, HasTheReadersDefaults) {
  const Schema& settings = cell_schema()["properties"];
  const CellDescription defaults;
  EXPECT_EQ(settings["clearance_m"]["default"], defaults.clearance_m);
  EXPECT_EQ(settings["checking"]["properties"]["delay_s"]["default"],
            to_seconds(defaults.checking.delay));
  EXPECT_EQ(settings["scheduling"]["properties"]["on_idle_blocker"]["default"],
            to_string(defaults.scheduling.on_idle_blocker));
  const Schema& robot = settings["robots"]["items"]["properties"];
  EXPECT_EQ(robot["base"]["properties"]["xyz"]["default"], Schema({0, 0, 0}));
  const Schema& limits =
      robot["arms"]["items"]["properties"]["limits"]["additionalProperties"]["properties"];
  EXPECT_EQ(limits["jerk_m_s3"]["default"], kDefaultJerk);
  EXPECT_FALSE(limits["brake_rad_s2"].contains("default"));
}

// Calls look() with the path and schema of every member.
void for_each_member(const Schema& schema, const std::string& place,
                     const std::function<void(const std::string&, const Schema&)>& look) {
  if (schema.contains("properties")) {
    for (const auto& [key, member] : schema["properties"].items()) {
      look(place + "/" + key, member);
      for_each_member(member, place + "/" + key, look);
    }
  }
  for (const char* inner : {"items", "additionalProperties"}) {
    if (schema.contains(inner) && schema[inner].is_object())
      for_each_member(schema[inner], place + "/*", look);
  }
}

TEST(CellSchema, DescribesEveryField) {
  const std::string reference = cell_reference_text();
  int fields = 0;
  for_each_member(cell_schema(), "", [&](const std::string& place, const Schema& member) {
    ++fields;
    ASSERT_TRUE(member.contains("description")) << place;
    const std::string text = member["description"];
    EXPECT_TRUE(text.ends_with(".")) << place;
    EXPECT_THAT(reference, HasSubstr(text)) << place;
    const std::string key = place.substr(place.rfind('/') + 1);
    EXPECT_THAT(reference, HasSubstr("| `" + key + "` | ")) << place;
  });
  EXPECT_GT(fields, 50);
}

TEST(SchemaReference, TakesTheUnitFromTheKey) {
  EXPECT_EQ(unit_of_key("clearance_m"), "m");
  EXPECT_EQ(unit_of_key("velocity_rad_s"), "rad/s");
  EXPECT_EQ(unit_of_key("jerk_m_s3"), "m/s³");
  EXPECT_EQ(unit_of_key("rate_hz"), "Hz");
  EXPECT_EQ(unit_of_key("limit_tolerance"), "");
}

class WrittenCell : public ::testing::TestWithParam<const char*> {};

TEST_P(WrittenCell, ReadsBackAsTheSame) {
  CellDescription cell = read(read_text_file(kConfig / GetParam()).value());
  cell.robots.front().joint_limits = "/moveit/joint_limits.yaml";
  cell.robots.front().fixed = {{"torso", 0.25}};
  cell.robots.front().arms.front().home.clear();
  cell.robots.front().arms.front().home_state = "ready";
  cell.objects.push_back({"ball", Sphere{0.2}, Eigen::Isometry3d::Identity()});
  cell.objects.push_back({"rod", Cylinder{0.1, 0.5}, Eigen::Isometry3d::Identity()});
  cell.objects.push_back({"part", Mesh{"/part.stl", {1, 2, 3}}, Eigen::Isometry3d::Identity()});
  const Schema once = written(cell);
  const CellDescription again = read(once.dump());
  EXPECT_EQ(written(again), once);
  EXPECT_EQ(again.robots.back().arms.back().limits.size(),
            cell.robots.back().arms.back().limits.size());

  const std::string commented =
      commented_json(once, cell_schema(), {{"", {"Made by a test."}}, {"/objects/1", {"A ball."}}});
  EXPECT_EQ(written(read(commented)), once) << commented;
  EXPECT_THAT(commented, HasSubstr("{\n  // Made by a test.\n"));
  EXPECT_THAT(commented, HasSubstr("    // A ball.\n    {\n      \"name\": \"ball\""));
  const std::string about =
      "// Clearance that every admitted motion keeps from other arms and the scene.\n";
  EXPECT_THAT(commented, HasSubstr(about));
  std::istringstream lines(commented);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
}

INSTANTIATE_TEST_SUITE_P(Configs, WrittenCell,
                         ::testing::Values("two_pandas.json", "dual_panda.json",
                                           "panda_and_ur5e.json", "two_shuttles.json"));

TEST(CommentedJson, EscapesLineBreaksInComments) {
  const Schema schema{{"properties", {{"a", {{"description", "x"}}}}}};
  const std::string text = commented_json({{"a", 1}}, schema, {{"/a", {"one\n\"b\": 2, */ two"}}});
  EXPECT_EQ(text, "{\n  // x\n  // one \"b\": 2, */ two\n  \"a\": 1\n}\n");
  EXPECT_EQ(*parse_json(text, JsonComments::allowed), nlohmann::json({{"a", 1}}));
}

TEST(NearestName, SuggestsTheMisspelledName) {
  const std::string_view known[] = {"rate_hz", "reaction_s", "xyz", "rpy"};
  EXPECT_EQ(nearest_name("rate_hx", known), "rate_hz");
  EXPECT_EQ(nearest_name("raet_hz", known), "rate_hz");
  EXPECT_EQ(nearest_name("reaction", known), "reaction_s");
  EXPECT_EQ(nearest_name("ryp", known), "rpy");
  EXPECT_EQ(nearest_name("velocity", known), std::nullopt);
  EXPECT_EQ(nearest_name("", known), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(1'000'000, 'r'), known), std::nullopt);
}

}  // namespace
}  // namespace armloom
