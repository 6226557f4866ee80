#include <gmock/gmock.h>

#include "test/geometry/mesh_file.h"

namespace armloom {
namespace {

using testing::HasSubstr;

constexpr const char* kRobot = R"(<robot name="r"><link name="l">
  <visual><geometry><mesh filename="look.dae"/></geometry></visual>
  <visual><geometry><mesh filename="gone.dae"/></geometry></visual>
  <collision><geometry><mesh filename="package://p/part.stl" scale="0.5 1 -1"/></geometry></collision>
</link><link name="tip"/><joint name="j" type="revolute"><parent link="l"/><child link="tip"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>)";

class MeshCell : public MeshFile {
 protected:
  CellDescription description() {
    CellDescription cell;
    cell.name = "c";
    cell.robots.push_back(
        {.name = "r", .urdf = folder_.write("r.urdf", kRobot), .srdf = "", .prefix = "r_"});
    cell.robots[0].packages["p"] = (folder_.path() / "package").string();
    cell.robots[0].arms.push_back({.name = "r", .group = ""});
    return cell;
  }
};

TEST_F(MeshCell, LoadsTheMeshesOfLinksAndObjects) {
  const std::string part = folder_.write("package/part.stl", small::stl_bytes(box_));
  folder_.write("look.dae", "seen by browsers only");
  CellDescription description = this->description();
  description.objects.push_back({"crate", Mesh{part, 2 * kOne}});
  const CellPtr cell = build_or_fail(description);
  const Mesh& link = std::get<Mesh>(cell->links[0].shapes[0].shape);
  ASSERT_NE(link.data, nullptr);
  expect_bounds(*link.data, {-0.05, -0.2, -0.75}, {0.15, 0.4, -0.5});
  const Mesh& crate = std::get<Mesh>(cell->objects[0].shape);
  ASSERT_NE(crate.data, nullptr);
  expect_bounds(*crate.data, {-0.2, -0.4, 1.0}, {0.6, 0.8, 1.5});
  const std::map<std::string, std::string> files{
      {"look.dae", std::filesystem::canonical(folder_.path() / "look.dae").string()},
      {"package://p/part.stl", std::filesystem::canonical(part).string()}};
  EXPECT_EQ(cell->robots[0].mesh_files, files);
}

TEST_F(MeshCell, NamesTheLinkOrObjectWhoseMeshIsBad) {
  folder_.write("package/part.stl", "solid a\nendsolid a\n");
  CellDescription cell = description();
  cell.objects.push_back({"crate", Mesh{folder_.write("crate.obj", "")}});
  cell.objects.push_back({"gone", Mesh{(folder_.path() / "gone.obj").string()}});
  const std::string problems = problems_of(cell);
  EXPECT_THAT(problems, HasSubstr("r.urdf:1: link l | r.urdf:1: link l: mesh "));
  EXPECT_THAT(problems, HasSubstr("/objects/0/mesh | object crate: mesh "));
  EXPECT_THAT(problems, HasSubstr("/objects/1/mesh | object gone: mesh "));
}

TEST_F(MeshCell, RejectsAMeshBehindASymlinkOutOfItsPackage) {
  folder_.write("secret.stl", small::stl_bytes(box_));
  std::filesystem::create_directory(folder_.path() / "package");
  std::filesystem::create_symlink(folder_.path() / "secret.stl",
                                  folder_.path() / "package/part.stl");
  EXPECT_THAT(problems_of(description()),
              testing::AllOf(HasSubstr("r.urdf:4: link l"), HasSubstr("through a symbolic link")));
}

}  // namespace
}  // namespace armloom
