#include "server/codec/cell_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/model/cell/build_cell.h"
#include "server/codec/read_text.h"
#include "server/messages/cell.h"
#include "server/recording/recording.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const fs::path kConfig = fs::path(source_dir()) / "config";

json two_pandas() {
  return json::parse(read_text_file(kConfig / "two_pandas.json").value(), nullptr, true, true);
}

TEST(CellCodec, ReadsTheTwoPandaCell) {
  const auto cell = read_cell_text(read_text_file(kConfig / "two_pandas.json").value(), kConfig);
  ASSERT_TRUE(cell) << cell.error().front().detail;
  ASSERT_EQ(cell->robots.size(), 2U);
  const RobotDescription& right = cell->robots[1];
  EXPECT_EQ(right.prefix, "right_");
  EXPECT_EQ(fs::path(right.urdf), (kConfig / "../models/panda.urdf").lexically_normal());
  EXPECT_NEAR(right.X_WB.translation().x(), 0.4, 1e-12);
  EXPECT_NEAR((right.X_WB * Eigen::Vector3d::UnitX()).x(), -0.6, 1e-12);  // faces the left robot
  EXPECT_EQ(right.arms.front().home.size(), 7U);
  EXPECT_EQ(right.arms.front().limits.at("panda_joint1").brake, 7.5);
  EXPECT_EQ(right.controller.lag, std::chrono::milliseconds(20));
  EXPECT_EQ(cell->objects.front().name, "table");
  EXPECT_EQ(cell->checking.limit_tolerance, 0.05);
  EXPECT_EQ(cell->monitor.stop_clearance_m, 0.01);
}

struct BadCell {
  const char* name;
  const char* at;
  const char* value;
  const char* says;
};

void PrintTo(const BadCell& bad, std::ostream* out) { *out << bad.name; }

class BadCellFile : public ::testing::TestWithParam<BadCell> {};

TEST_P(BadCellFile, IsRefusedWithPlaceAndReason) {
  json file = two_pandas();
  const json::json_pointer place(GetParam().at);
  if (GetParam().value == nullptr) {
    file[place.parent_pointer()].erase(place.back());
  } else {
    file[place] = json::parse(GetParam().value);
  }
  const auto cell = read_cell_text(file.dump(), kConfig);
  ASSERT_FALSE(cell);
  EXPECT_EQ(cell.error().front().pointer, GetParam().at);
  EXPECT_NE(cell.error().front().detail.find(GetParam().says), std::string::npos)
      << cell.error().front().detail;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadCellFile,
    ::testing::Values(
        BadCell{"UnknownKey", "/robots/0/urfd", "\"x\"", "unknown field \"urfd\""},
        BadCell{"UnknownSetting", "/checking/time_step", "0.05", "unknown field"},
        BadCell{"NoName", "/name", nullptr, "missing"},
        BadCell{"NoUrdf", "/robots/1/urdf", nullptr, "missing"},
        BadCell{"RobotsEmpty", "/robots", "[]", "at least one"},
        BadCell{"ArmsEmpty", "/robots/0/arms", "[]", "at least one"},
        BadCell{"XyzShort", "/robots/0/base/xyz", "[1, 2]", "expected 3 numbers, found 2"},
        BadCell{"HomeIsText", "/robots/0/arms/0/home/3", "\"x\"", "a number"},
        BadCell{"BaseIsFar", "/robots/0/base/xyz", "[0, 2000, 0]", "2000 is not within"},
        BadCell{"LimitIsZero", "/robots/0/arms/0/limits/panda_joint1/brake_rad_s2", "0", "greater"},
        BadCell{"BoxIsFlat", "/objects/0/box", "[1, 1, 0]", "greater than zero"},
        BadCell{"TwoShapes", "/objects/0", R"({"name": "x", "box": [1,1,1], "sphere": [1]})",
                "exactly one"},
        BadCell{"ScaleOfABox", "/objects/0/scale", "[1, 1, 1]", R"("scale" requires "mesh")"},
        BadCell{"RenamedKey", "/scheduling/horizon_legs", "5",
                "renamed to \"horizon_steps\" in version 0.2"},
        BadCell{"MisspeltKey", "/monitor/rate_hx", "5", "did you mean \"rate_hz\"?"},
        BadCell{"HomeIsANumber", "/robots/0/arms/0/home", "7", "or the name of a state"},
        BadCell{"HomeIsNameless", "/robots/0/arms/0/home", "\"\"", "a name is required"},
        BadCell{"FixedAtText", "/robots/0/fixed/torso", "\"up\"", "a number"},
        BadCell{"JointLimitsEmpty", "/robots/0/joint_limits", "\"\"", "a path is required"},
        BadCell{"VelocityIsNegative", "/robots/0/arms/0/limits/panda_joint1/velocity_rad_s", "-1",
                "greater than zero"},
        BadCell{"LimitInBothUnits", "/robots/0/arms/0/limits/panda_joint1",
                R"({"brake_rad_s2": 1, "brake_m_s2": 1})", "at most one of"},
        BadCell{"Policy", "/scheduling/policy", "\"hopeful\"", "\"earliest_start\""},
        BadCell{"IdleBlocker", "/scheduling/on_idle_blocker", "\"shove\"",
                "expected \"report\", \"park\" or \"replan\""},
        BadCell{"PairIsSingle", "/allowed_collisions/0", "[\"table\"]", "an array of 2"},
        BadCell{"StepIsZero", "/checking/time_step_s", "0", "not within"},
        BadCell{"RateIsHigh", "/monitor/rate_hz", "5000", "not within"},
        BadCell{"Controller", "/robots/0/controller/type", "\"real\"", "sim"},
        BadCell{"Clearance", "/clearance_m", "-0.1", "not within"}),
    [](const auto& tested) { return tested.param.name; });

TEST(CellCodec, ReadsJointLimitsFilesFixedJointsAndNamedStates) {
  json file = two_pandas();
  file["$schema"] = "cell.schema.json";
  json& robot = file["robots"][0];
  robot["joint_limits"] = "moveit/joint_limits.yaml";
  robot["fixed"] = {{"torso_lift_joint", 0.1}};
  robot["arms"][0]["home"] = "ready";
  robot["arms"][0]["limits"] = {
      {"panda_joint1", {{"velocity_rad_s", 1.5}, {"lower_rad", -2}, {"upper_rad", 2}}},
      {"panda_finger_joint1", {{"velocity_m_s", 0.1}, {"upper_m", 0.03}}}};
  const auto cell = read_cell_text(file.dump(), kConfig);
  ASSERT_TRUE(cell) << cell.error().front().detail;
  const RobotDescription& left = cell->robots.front();
  EXPECT_EQ(fs::path(left.joint_limits), kConfig / "moveit/joint_limits.yaml");
  EXPECT_EQ(left.fixed.at("torso_lift_joint"), 0.1);
  EXPECT_EQ(left.arms.front().home_state, "ready");
  EXPECT_TRUE(left.arms.front().home.empty());
  const auto& limits = left.arms.front().limits;
  EXPECT_EQ(limits.at("panda_joint1").velocity, 1.5);
  EXPECT_EQ(limits.at("panda_joint1").lower, -2.0);
  EXPECT_EQ(limits.at("panda_finger_joint1").velocity, 0.1);
  EXPECT_EQ(limits.at("panda_finger_joint1").upper, 0.03);
  EXPECT_FALSE(limits.at("panda_joint1").acceleration);
}

TEST(CellCodec, ReportsAllFaultsAtOnce) {
  json file = two_pandas();
  file["clearance_m"] = -1;
  file["robots"][0]["urfd"] = "x";
  file["robots"][1].erase("srdf");
  file["monitor"]["rate_hz"] = "fast";
  file["objects"][0]["box"] = {1, 1};
  const auto cell = read_cell_text(file.dump(), kConfig);
  ASSERT_FALSE(cell);
  std::vector<std::string> places;
  for (const Problem& problem : cell.error()) places.push_back(problem.pointer);
  EXPECT_THAT(places,
              testing::UnorderedElementsAre("/clearance_m", "/robots/0/urfd", "/robots/1/srdf",
                                            "/monitor/rate_hz", "/objects/0/box"));
}

TEST(CellCodec, WritesTheViewForTheDashboard) {
  const auto description = read_cell_text(two_pandas().dump(), kConfig);
  ASSERT_TRUE(description);
  const auto cell = build_cell(*description);
  ASSERT_TRUE(cell);
  const json out = json::parse(text_of(*cell_view_format(), view_of(**cell, "sequential", 2.0)));
  EXPECT_EQ(out["name"], "two_pandas");
  EXPECT_EQ(out["policy"], "sequential");
  EXPECT_EQ(out["speed"], 2.0);
  const json& right = out["robots"][1];
  EXPECT_NE(right["urdf"].get<std::string>().find("<robot"), std::string::npos);
  EXPECT_NEAR(std::abs(right["base"]["rpy"][2].get<double>()), 3.14159265358979, 1e-12);
  EXPECT_EQ(right["arms"][0]["joints"][0], "right_panda_joint1");
  EXPECT_EQ(right["arms"][0]["home"].size(), 7U);
  EXPECT_EQ(out["objects"][0]["box"], json::parse("[2, 2, 0.1]"));
  EXPECT_EQ(out["joints"][0]["arm"], "left");
  EXPECT_EQ(out["joints"][0]["unit"], "rad");
  EXPECT_EQ(out["scheduling"]["backlog_timeout_s"], 60.0);
}

TEST(CellCodec, ViewHasTheControllersWithPromisesInEffect) {
  json file = two_pandas();
  file["checking"]["tracking_error_rad"] = 0.003;
  file["robots"][1]["controller"] = {{"type", "remote"},          {"endpoint", "unix:/tmp/right"},
                                     {"reaction_s", 0.03},        {"feedback_period_s", 0.004},
                                     {"feedback_timeout_s", 0.2}, {"tracking_error_rad", 0.002}};
  const CellPtr cell = *build_cell(*read_cell_text(file.dump(), kConfig));
  const json out = json::parse(text_of(*cell_view_format(), view_of(*cell, "sequential", 1.0)));
  const json defaults = {{"type", "sim"},
                         {"reaction_s", 0.02},
                         {"feedback_period_s", 0.001},
                         {"feedback_timeout_s", 0.1},
                         {"tracking_error_rad", 0.003}};
  json given = file["robots"][1]["controller"];
  given.erase("endpoint");
  EXPECT_EQ(out["robots"][0]["controller"], defaults);
  EXPECT_EQ(out["robots"][1]["controller"], given);
  EXPECT_EQ(out["simulated"], false);
}

TEST(CellCodec, ReadsAnglesInDegreesToo) {
  json cell = two_pandas();
  cell["robots"][0]["base"] = {{"xyz", {0, 0, 0}}, {"rpy_deg", {0, 90, 180}}};
  const auto read = read_cell_text(cell.dump(), kConfig);
  ASSERT_TRUE(read) << read.error().front().detail;
  cell["robots"][0]["base"] = {{"xyz", {0, 0, 0}}, {"rpy", {0, M_PI / 2, M_PI}}};
  const auto same = read_cell_text(cell.dump(), kConfig);
  EXPECT_TRUE(read->robots[0].X_WB.isApprox(same->robots[0].X_WB, 1e-12));
  cell["robots"][0]["base"]["rpy_deg"] = {0, 90, 180};
  EXPECT_EQ(read_cell_text(cell.dump(), kConfig).error().front().slug, "more-than-one");
}

TEST(CellCodec, WritesAPoseWithoutMinusZero) {
  json cell = two_pandas();
  cell["robots"][0]["base"]["rpy"] = {-0.0, 0.0, -0.0};
  const auto description = read_cell_text(cell.dump(), kConfig);
  ASSERT_TRUE(description);
  const CellPtr built = *build_cell(*description);
  const std::string out = text_of(*cell_view_format(), view_of(*built, "sequential", 1.0));
  EXPECT_NE(out.find("\"rpy\":[0,0,0]"), out.npos);
  for (const char* minus_zero : {"[-0,", "[-0]", ",-0,", ",-0]", ":-0,", ":-0}"}) {
    EXPECT_EQ(out.find(minus_zero), out.npos) << minus_zero;
  }
}

}  // namespace
}  // namespace armloom
