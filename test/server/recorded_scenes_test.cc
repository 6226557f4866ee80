#include "server/recording/recorded_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/geometry/mesh/mesh.h"
#include "server/messages/events.h"
#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class RecordedScenes : public ::testing::Test {
 protected:
  RecordedScenes() {
    Cell cell = *build_cell(crossing_description()).value();
    hull_ = {.name = "hull",
             .shape = Mesh{"/robots/hull.stl", Eigen::Vector3d::Ones(),
                           std::make_shared<const MeshData>()}};
    cell.objects.push_back(hull_);
    cell_ = std::make_shared<const Cell>(std::move(cell));
    folder_ = fs::path(::testing::TempDir()) / "armloom-scenes" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void write(const std::string& text) const {
    std::ofstream(folder_ / "events.jsonl", std::ios::binary) << text;
  }
  // Returns the place and the sentence of the first problem.
  std::string fault_of(const std::string& data) const {
    write("{\"type\": \"arm\"}\n{\"type\": \"scene\", \"t_s\": 1, \"data\": " + data + "}\n");
    const auto scenes = read_scenes(folder_, *cell_);
    if (scenes) return "none";
    return scenes.error().front().pointer + ": " + scenes.error().front().detail;
  }

  CollisionObject hull_;
  CellPtr cell_;
  fs::path folder_;
};

TEST_F(RecordedScenes, AreThoseOfTheEvents) {
  CollisionObject box{.name = "box", .shape = Box{{0.1, 0.2, 0.3}}};
  box.X_WO.translation() = Eigen::Vector3d(1, 2, 3);
  box.X_WO.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()));
  CollisionObject rod{.name = "rod", .shape = Cylinder{0.02, 0.5}};
  rod.X_WO.translation() = Eigen::Vector3d(0.125, 0, 0);
  SceneView first{7, std::make_shared<const std::vector<CollisionObject>>(1, box)};
  first.held = {{rod, "x_ball", "x", {"y_ball", "box"}}, {hull_, "y_ball", "y", {}}};
  first.touch = {{"box", {"x_ball", "y_ball"}}};
  const SceneView second{8, std::make_shared<const std::vector<CollisionObject>>(1, hull_)};
  write(event_json({1, at(1500ms), Alert{Alert::Level::info, "\"scene\""}}, "s", nullptr) + "\n" +
        event_json({2, at(1500ms), first}, "s", nullptr) + "\n" +
        event_json({3, at(2s + 1ns), second}, "s", nullptr) + "\n");
  std::vector<std::string> warnings;
  const auto scenes = read_scenes(folder_, *cell_, &warnings);
  ASSERT_TRUE(scenes) << scenes.error().front().pointer << scenes.error().front().detail;
  EXPECT_TRUE(warnings.empty());

  ASSERT_EQ(scenes->size(), 2U);
  const LinkId x = *cell_->find_link("x_ball");
  const LinkId y = *cell_->find_link("y_ball");
  const RecordedScene& read = scenes->front();
  EXPECT_EQ(read.time, at(1500ms));
  ASSERT_EQ(read.objects.size(), 1U);
  EXPECT_EQ(read.objects[0].shape, box.shape);
  EXPECT_TRUE(read.objects[0].X_WO.isApprox(box.X_WO, 1e-12));
  ASSERT_EQ(read.held.size(), 2U);
  EXPECT_EQ(read.held[0].object.name, "rod");
  EXPECT_EQ(read.held[0].object.shape, rod.shape);
  EXPECT_EQ(read.held[0].link, x);
  EXPECT_TRUE(read.held[0].X_LO.isApprox(rod.X_WO));
  EXPECT_THAT(read.held[0].touch, ElementsAre(y));
  EXPECT_THAT(read.held[0].touch_objects, ElementsAre("box"));
  EXPECT_EQ(read.held[1].object.shape, hull_.shape) << "with its data";
  EXPECT_THAT(read.touch, ElementsAre(AllowedTouch{"box", {x, y}}));
  EXPECT_EQ(scenes->back().time, at(2s + 1ns));
  EXPECT_EQ(scenes->back().objects[0].shape, hull_.shape);
  EXPECT_TRUE(scenes->back().held.empty());
}

TEST_F(RecordedScenes, AreNoneWithoutEvents) {
  EXPECT_TRUE(read_scenes(folder_, *cell_).value().empty());
  write("{\"type\": \"arm\", \"t_s\": 0, \"data\": {}}\n");
  EXPECT_TRUE(read_scenes(folder_, *cell_).value().empty());
}

TEST_F(RecordedScenes, NeedNoHeldObjects) {  // recordings of older versions
  write("{\"type\": \"scene\", \"t_s\": 0, \"data\": {\"version\": 2, \"objects\": []}}\n");
  EXPECT_EQ(read_scenes(folder_, *cell_).value().size(), 1U);
}

TEST_F(RecordedScenes, WarnOfACutOffLine) {
  write(
      "{\"type\": \"scene\", \"t_s\": 0, \"data\": {\"objects\": []}}\n{\"type\": \"scene\", \"t_");
  std::vector<std::string> warnings;
  EXPECT_EQ(read_scenes(folder_, *cell_, &warnings).value().size(), 1U);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("events.jsonl:2: the last line has no line end")));
}

TEST_F(RecordedScenes, NameThePlaceOfAFault) {
  const auto held = [](const std::string& members) {
    return "{\"objects\": [], \"held\": [{\"object\": {\"name\": \"p\", \"sphere\": [0.1]}" +
           members + "}]}";
  };
  EXPECT_EQ(fault_of(held(", \"link\": \"x_ball\"")), "none");
  EXPECT_THAT(fault_of(held("")), HasSubstr("events.jsonl:2/data/held/0"));
  EXPECT_EQ(fault_of(held(", \"link\": \"z\"")),
            "events.jsonl:2/data/held/0/link: the cell has no link z");
  EXPECT_EQ(fault_of(held(", \"link\": \"x_rail\"")),
            "events.jsonl:2/data/held/0/link: no arm moves link x_rail");
  EXPECT_THAT(fault_of("{}"), HasSubstr("events.jsonl:2/data"));
  EXPECT_THAT(fault_of("{\"objects\": [{\"name\": \"p\"}]}"),
              HasSubstr("events.jsonl:2/data/objects/0"));
  EXPECT_EQ(fault_of("{\"objects\": [{\"name\": \"p\", \"mesh\": \"/api/v1/cell/meshes/1.stl\"}]}"),
            "events.jsonl:2/data/objects/0: the cell has no object p with a mesh");
  EXPECT_THAT(fault_of("{"), HasSubstr("events.jsonl:2"));
  write(
      "{\"type\": \"scene\", \"t_s\": 2, \"data\": {\"objects\": []}}\n"
      "{\"type\": \"scene\", \"t_s\": 1, \"data\": {\"objects\": []}}\n");
  EXPECT_EQ(read_scenes(folder_, *cell_).error().front().pointer, "events.jsonl:2/t_s");
}

}  // namespace
}  // namespace armloom
