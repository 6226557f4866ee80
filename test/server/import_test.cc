#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/import/homes.h"
#include "server/import/packages.h"
#include "server/import/placement.h"
#include "server/recording/recording.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Key;
using testing::Pair;
namespace fs = std::filesystem;

class PackageFolders : public ::testing::Test {
 protected:
  void SetUp() override {
    top_ = fs::canonical(::testing::TempDir()) / "armloom-packages" /
           ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(top_);
  }
  void put(const std::string& file) const {
    fs::create_directories((top_ / file).parent_path());
    std::ofstream(top_ / file) << "x";
  }
  fs::path top_;
};

TEST_F(PackageFolders, AreFoundByTheirContents) {
  put("ws/arm_description/meshes/link.stl");
  put("ws/arm_moveit_config/config/arm.urdf");
  put("opt/share/hand/hand.stl");
  put("ws/renamed/meshes/table.stl");
  const std::string urdf = R"(<r><mesh filename="package://arm_description/meshes/link.stl"/>
    <mesh filename='package://arm_description/meshes/left_out.dae'/>
    <mesh filename="package://hand//hand.stl"/> <mesh filename="package://nowhere/x.stl"/>
    <mesh filename="package://given/ws/renamed/meshes/table.stl"/>
    <!-- <mesh filename="package://commented_out/x.stl"/> --></r>)";
  const Packages found = find_packages(urdf, top_ / "ws/arm_moveit_config/config/arm.urdf",
                                       {{"given", top_.string()}}, {top_ / "opt/share"});
  EXPECT_THAT(
      found.folders,
      ElementsAre(Pair("arm_description", (top_ / "ws/arm_description").string()),
                  Pair("given", top_.string()), Pair("hand", (top_ / "opt/share/hand").string())));
  EXPECT_THAT(found.missing, ElementsAre(Key("nowhere")));
  // The folder has another name than the package, contains the files, and is above the URDF.
  const Packages renamed =
      find_packages(R"(<mesh filename="package://table_description/meshes/table.stl"/>)",
                    top_ / "ws/renamed/urdf/table.urdf", {}, {});
  EXPECT_THAT(renamed.folders,
              ElementsAre(Pair("table_description", (top_ / "ws/renamed").string())));
}

TEST(Placement, IsReadInMetersAndDegrees) {
  const auto placed = read_placement("right:x=0.75,z=-1e-1,yaw_deg=180");
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->name, "right");
  EXPECT_EQ(placed->base.xyz_m, Eigen::Vector3d(0.75, 0, -0.1));
  EXPECT_EQ(placed->base.rpy_rad, Eigen::Vector3d(0, 0, std::numbers::pi));
  EXPECT_EQ(read_placement("left")->base.xyz_m, Eigen::Vector3d::Zero());
}

TEST(Placement, IsRefusedWithAReason) {
  for (const auto& [text, says] :
       {std::pair{":x=1", "the name is missing"},
        {"a:w=1", "\"w\" is an unknown key"},
        {"a:yaw=90", "\"yaw\" is an unknown key"},
        {"a:x", "\"x\" is not KEY=NUMBER"},
        {"a:x=1m", "\"x=1m\" is not KEY=NUMBER"},
        {"a:x=nan", "\"x=nan\" is not KEY=NUMBER"},
        {"a:x=1,,y=2", "\"\" is an unknown key"},
        {":x=abc,foo=1,yaw_deg=nan",
         "the name is missing; \"x=abc\" is not KEY=NUMBER; \"foo\" is an "
         "unknown key; \"yaw_deg=nan\" is not KEY=NUMBER; expected"}}) {
    const auto placed = read_placement(text);
    ASSERT_FALSE(placed) << text;
    EXPECT_EQ(placed.error().front().pointer, "--robot");
    EXPECT_THAT(placed.error().front().detail, HasSubstr(says));
  }
}

CellDescription facing_pandas(double apart_m) {
  const fs::path folder = fs::path(source_dir()) / "config";
  CellDescription cell =
      read_cell_text(read_text_file(folder / "two_pandas.json").value(), folder).value();
  cell.objects.clear();
  cell.allowed_collisions.clear();
  cell.robots[0].X_WB.translation() = Eigen::Vector3d(-apart_m / 2, 0, 0);
  cell.robots[1].X_WB.translation() = Eigen::Vector3d(apart_m / 2, 0, 0);
  for (RobotDescription& robot : cell.robots) robot.arms.front().home.clear();
  return cell;
}

TEST(ChosenHomes, AreTheHomeStatesIfCollisionFree) {
  const auto cell = build_cell(facing_pandas(2.5));
  ASSERT_TRUE(cell);
  const auto homes = choose_homes(*cell);
  ASSERT_TRUE(homes);
  EXPECT_TRUE(homes->is_free);
  for (const HomeCandidate& home : homes->of_arm) EXPECT_EQ(home.state, "home");
}

TEST(ChosenHomes, AreOtherStatesIfTheHomeStatesCollide) {
  // Too close for both home states.
  const CellDescription near = facing_pandas(0.4);
  const auto cell = build_cell(near);
  ASSERT_TRUE(cell);
  const auto homes = choose_homes(*cell);
  ASSERT_TRUE(homes);
  ASSERT_TRUE(homes->is_free);
  EXPECT_FALSE(homes->of_arm[0].state == "home" && homes->of_arm[1].state == "home");
  const HomePlaces chosen{{{homes->of_arm[0].q, 0.02}}, {{homes->of_arm[1].q, 0.02}}};
  EXPECT_TRUE(find_free_homes(*cell, chosen)->chosen);
  const HomePlaces wanted{{{homes->wanted[0].q, 0.02}}, {{homes->wanted[1].q, 0.02}}};
  EXPECT_FALSE(find_free_homes(*cell, wanted)->chosen);
  const auto again = choose_homes(*cell);
  EXPECT_EQ(again->of_arm[1].q, homes->of_arm[1].q);
}

TEST(ChosenHomes, AreReportedAsCollidingIfNoneIsFree) {
  const auto cell = build_cell(facing_pandas(0.0));  // the same place
  ASSERT_TRUE(cell);
  const auto homes = choose_homes(*cell);
  ASSERT_TRUE(homes);
  EXPECT_FALSE(homes->is_free);
  // Other bases would help, so no pair is told as too close for good.
  EXPECT_THAT(homes->found.lasting, testing::IsEmpty());
  ASSERT_FALSE(homes->found.frequent.empty());
  const HomeObstacle& obstacle = homes->found.frequent.front();
  EXPECT_EQ(obstacle.arm, ArmId(0));
  EXPECT_THAT(obstacle.body_a, testing::StartsWith("left_"));
  EXPECT_THAT(obstacle.body_b, testing::StartsWith("right_"));
  EXPECT_EQ(obstacle.places, homes->tried[0]);
  EXPECT_EQ(homes->of_arm[0].state, homes->wanted[0].state);
}

TEST(HomeCandidates, KeepTheJointLimits) {
  const auto cell = build_cell(facing_pandas(2.5));
  ASSERT_TRUE(cell);
  const Arm& arm = (*cell)->arms.front();
  for (const HomeCandidate& candidate : home_candidates(**cell, arm)) {
    for (std::size_t j = 0; j < arm.joints.size(); ++j) {
      const Joint& joint = (*cell)->joint(arm.joints[j]);
      EXPECT_GE(candidate.q[static_cast<Eigen::Index>(j)], joint.lower);
      EXPECT_LE(candidate.q[static_cast<Eigen::Index>(j)], joint.upper);
    }
  }
}

}  // namespace
}  // namespace armloom
