#include <gmock/gmock.h>

#include "core/collision/state/check_home.h"
#include "test/collision/busy_cell.h"

namespace armloom {
namespace {

using namespace busy;

TEST(PlanningScene, RejectsAndListsAllUnloadedMeshes) {
  Cell cell = busy_cell();
  small::add_shape(cell.links[2], Mesh{"hand.stl"}, Eigen::Isometry3d::Identity());
  cell.objects.push_back({"part", Mesh{"part.stl"}});
  const auto scene = PlanningScene::build(small::shared(cell));
  ASSERT_FALSE(scene.has_value());
  ASSERT_EQ(scene.error().size(), 2U);
  EXPECT_EQ(scene.error()[0].kind, ProblemKind::unsupported);
  EXPECT_THAT(scene.error()[0].detail, ::testing::HasSubstr("hand.stl"));
  EXPECT_EQ(scene.error()[1].pointer, "/objects/4/mesh");
}

TEST(PlanningScene, RejectsDuplicateAndUnknownNames) {
  Cell cell = busy_cell();
  cell.objects.push_back({"rod", Sphere{0.1}});
  cell.allowed.link_objects.insert({LinkId{1}, "tabel"});
  const auto scene = PlanningScene::build(small::shared(cell));
  ASSERT_FALSE(scene.has_value());
  ASSERT_EQ(scene.error().size(), 2U);
  EXPECT_EQ(scene.error()[0].pointer, "/objects/4/name");
  EXPECT_THAT(scene.error()[1].detail, ::testing::HasSubstr("tabel"));
}

TEST(CheckHome, ReportsEveryPairTooCloseAtHome) {
  Cell cell;
  cell.clearances.clearance_m = 0.02;
  small::add_robot(cell, "left", small::at_xyz(0, 0, 0), {kZ}, {0.3, 0.05});
  small::add_robot(cell, "right", small::at_xyz(0, 0.13, 0), {kZ}, {0.3, 0.05});
  EXPECT_TRUE(check_home(scene_of(small::shared(cell))).empty());
  cell.clearances.clearance_m = 0.031;
  cell.objects.push_back({"shelf", Box{{1, 1, 0.1}}, small::at_xyz(0, 0, -0.12)});
  const Problems problems = check_home(scene_of(small::shared(cell)));
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[0].pointer, "/robots/0/arms/0/home");
  EXPECT_EQ(
      problems[0].detail,
      "left_link1 and right_link1: 0.0300 m apart at home, clearance_m is 0.0310 (give another "
      "\"home\" or move one of them)");
  EXPECT_THAT(problems[2].detail, ::testing::StartsWith("right_link1 and shelf: 0.0200 m"));
}

TEST(CheckHome, ReportsPairsThatTheSrdfDisables) {
  Cell cell;
  small::add_robot(cell, "left", small::at_xyz(0, 0, 0), {kZ}, {0.3, 0.05});
  small::add_robot(cell, "right", small::at_xyz(0, 0.11, 0), {kZ}, {0.3, 0.05});
  cell.allowed.claimed_pairs[{*cell.find_link("left_link1"), *cell.find_link("right_link1")}] =
      "dual.srdf:17";
  const Problems problems = check_home(scene_of(small::shared(cell)));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0].detail,
              ::testing::EndsWith(
                  "; if these two may touch, add [\"left_link1\", \"right_link1\"] to the cell's "
                  "\"allowed_collisions\"; dual.srdf:17 disables the pair without proof, so it is "
                  "checked)"));
}

}  // namespace
}  // namespace armloom
