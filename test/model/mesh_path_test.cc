#include "core/model/urdf/mesh_path.h"

#include <gmock/gmock.h>

#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class MeshPath : public testing::Test {
 protected:
  MeshPath() {
    folder_.write("robot/meshes/a.stl", "solid a");
    folder_.write("package/meshes/b.stl", "solid b");
    folder_.write("secret.stl", "solid secret");
    std::filesystem::create_symlink(folder_.path() / "secret.stl",
                                    folder_.path() / "package/meshes/link.stl");
    std::filesystem::create_symlink(folder_.path(), folder_.path() / "package/up");
    std::filesystem::create_symlink("b.stl", folder_.path() / "package/meshes/inner.stl");
  }

  tl::expected<std::filesystem::path, std::string> resolve(const std::string& uri) const {
    return resolve_mesh(uri, folder_.path() / "robot",
                        {{"p", (folder_.path() / "package").string()}});
  }
  std::string refusal(const std::string& uri) const {
    const auto path = resolve(uri);
    return path ? "accepted: " + path->string() : path.error();
  }

  ScratchFolder folder_;
};

TEST_F(MeshPath, FindsFilesInPackagesAndNextToTheUrdf) {
  EXPECT_EQ(resolve("package://p/meshes/b.stl"),
            std::filesystem::canonical(folder_.path() / "package/meshes/b.stl"));
  EXPECT_EQ(resolve("package://p/meshes/../meshes/inner.stl"),
            std::filesystem::canonical(folder_.path() / "package/meshes/b.stl"));
  EXPECT_EQ(resolve("package://p//meshes//b.stl"),
            std::filesystem::canonical(folder_.path() / "package/meshes/b.stl"));
  EXPECT_EQ(resolve("../package/meshes/b.stl"),
            std::filesystem::canonical(folder_.path() / "package/meshes/b.stl"));
  EXPECT_EQ(resolve("meshes/a.stl"),
            std::filesystem::canonical(folder_.path() / "robot/meshes/a.stl"));
}

TEST_F(MeshPath, RejectsPathsThatLeaveTheFolder) {
  EXPECT_THAT(refusal("package://p/../secret.stl"), HasSubstr("leaves its folder"));
  EXPECT_THAT(refusal("package://p/meshes/../../secret.stl"), HasSubstr("leaves its folder"));
  // A repeated slash counts once, so this is a path below the package.
  EXPECT_THAT(refusal("package://p//etc/hostname"), HasSubstr("does not exist"));
  EXPECT_THAT(refusal("package://p//../secret.stl"), HasSubstr("leaves its folder"));
  EXPECT_THAT(refusal("../secret.stl"),
              AllOf(HasSubstr("lies neither below the URDF's folder nor below one of the cell's "
                              "packages"),
                    HasSubstr("add to the robot \"packages\": {")));
}

TEST_F(MeshPath, RejectsSymlinksThatLeaveTheFolder) {
  EXPECT_THAT(refusal("package://p/meshes/link.stl"), HasSubstr("through a symbolic link"));
  EXPECT_THAT(refusal("package://p/up/secret.stl"), HasSubstr("through a symbolic link"));
}

TEST_F(MeshPath, AcceptsAbsolutePathsBelowAllowedFolders) {
  const std::string inside = (folder_.path() / "package/meshes/b.stl").string();
  const auto real = std::filesystem::canonical(inside);
  EXPECT_EQ(resolve("file://" + inside), real);
  EXPECT_EQ(resolve("file://localhost" + inside), real);
  EXPECT_EQ(resolve("file://" + folder_.path().string() + "/package/mesh%65s/b%2Estl"), real);
  EXPECT_EQ(resolve(inside), real);
  EXPECT_EQ(resolve("file://" + (folder_.path() / "robot/meshes/a.stl").string()),
            std::filesystem::canonical(folder_.path() / "robot/meshes/a.stl"));
}

// Addresses of another machine, as xacro writes them there. The folder here has another name.
TEST_F(MeshPath, FindsThePackageInPathsOfAnotherMachine) {
  const auto real = std::filesystem::canonical(folder_.path() / "package/meshes/b.stl");
  EXPECT_EQ(resolve("file:///home/other/ws/src/p/meshes/b.stl"), real);
  EXPECT_EQ(resolve("file:///home/other/ws/install/p/share/p/meshes/b.stl"), real);
  EXPECT_EQ(resolve("/home/other/ws/src/p//meshes/b.stl"), real);
  EXPECT_THAT(refusal("file:///home/other/p/meshes/c.stl"),
              HasSubstr("does not exist: " + (folder_.path() / "package/meshes/c.stl").string()));
  EXPECT_THAT(refusal("file:///home/other/p/meshes/link.stl"), HasSubstr("a symbolic link"));
  EXPECT_THAT(refusal("file:///home/other/p/../secret.stl"), HasSubstr("lies neither"));
}

TEST_F(MeshPath, NeverSuggestsAFolderThatDoesNotExist) {
  const std::string ask =
      "\"packages\": {\"arm\": \"FOLDER\"} with the folder on this machine that "
      "contains meshes/c.stl";
  EXPECT_THAT(refusal("file:///home/other/ws/arm/meshes/c.stl"), HasSubstr(ask));
  EXPECT_THAT(refusal("package://arm//meshes/c.stl"), HasSubstr(ask));
  folder_.write("arm/readme", "");
  EXPECT_THAT(refusal("file:///home/other/ws/arm/meshes/c.stl"),
              HasSubstr("{\"arm\": \"" + (folder_.path() / "arm").string() + "\"}"));
}

TEST_F(MeshPath, SuggestsThePackagesEntryForAnAbsolutePath) {
  folder_.write("elsewhere/arm_description/meshes/visual/c.stl", "solid c");
  const auto real = std::filesystem::canonical(folder_.path() / "elsewhere").string();
  EXPECT_THAT(refusal("file://" + real + "/arm_description/meshes/visual/c.stl"),
              HasSubstr("add to the robot \"packages\": {\"arm_description\": \"" + real +
                        "/arm_description\"}"));
  EXPECT_THAT(refusal("package://package/x.stl"),
              HasSubstr("add to the robot \"packages\": {\"package\": \""));
  EXPECT_THAT(refusal("file:///etc/hostname"), HasSubstr("lies neither below the URDF's folder"));
  EXPECT_THAT(refusal("file://host/a.stl"),
              AllOf(HasSubstr("another host, host:"), HasSubstr("three slashes (file:///home")));
  EXPECT_THAT(refusal("file://" + (folder_.path() / "package/meshes/link.stl").string()),
              HasSubstr("lies neither"));
}

// The author of a URDF must not learn which files exist on the machine.
TEST_F(MeshPath, DoesNotRevealWhichFilesExistElsewhere) {
  folder_.write("elsewhere/arm/meshes/c.stl", "solid c");
  folder_.write("elsewhere/arm/package.xml", "<package/>");
  const std::string arm = (folder_.path() / "elsewhere/arm").string();
  std::filesystem::create_symlink(folder_.path() / "elsewhere", folder_.path() / "robot/out");
  const std::string there = refusal("file://" + arm + "/meshes/c.stl");
  EXPECT_THAT(there, HasSubstr("{\"arm\": \"" + arm + "\"}"));
  EXPECT_EQ(refusal("file://" + arm + "/meshes/d.stl"), there);
  EXPECT_EQ(refusal(arm + "/meshes/no/d.stl"), there);
  EXPECT_EQ(refusal("../elsewhere/arm/meshes/c.stl"), refusal("../elsewhere/arm/meshes/d.stl"));
  EXPECT_EQ(refusal("out/arm/package.xml"), refusal("out/arm/no.xml"));
  EXPECT_EQ(refusal("file:///etc/hostname"), refusal("file:///etc/no-such-file"));
}

TEST_F(MeshPath, ReportsBadFilesInAllowedFolders) {
  EXPECT_THAT(refusal("file://" + (folder_.path() / "package/meshes/B.stl").string()),
              AllOf(HasSubstr("does not exist"), HasSubstr("; did you mean b.stl?")));
  EXPECT_THAT(refusal("file://" + (folder_.path() / "package/meshes").string()),
              HasSubstr("is not a regular file"));
}

TEST_F(MeshPath, RejectsOtherSchemesAndNonFiles) {
  EXPECT_THAT(refusal("http://127.0.0.1/a.stl"),
              AllOf(HasSubstr("neither package://"), HasSubstr("save the file next to the URDF")));
  EXPECT_THAT(refusal("package://q/a.stl"), HasSubstr("package 'q'"));
  EXPECT_THAT(refusal("package://p"), HasSubstr("names no file"));
  EXPECT_THAT(refusal("package://p/meshes"), HasSubstr("not a regular file"));
  EXPECT_THAT(refusal("package://p/meshes/missing.stl"), HasSubstr("does not exist"));
  EXPECT_THAT(refusal(""), HasSubstr("leaves its folder"));
}

TEST(MeshNames, AreReplacedIfTheMapHasAnotherName) {
  const std::string urdf = R"(<?xml version="1.0"?>
<robot name="r"><!-- of the maker --><link name="a">
  <visual><geometry><mesh filename="package://p/a.dae"/></geometry></visual>
  <collision><geometry><mesh filename="package://p/a &amp; b.stl" scale="2 2 2"/></geometry></collision>
</link></robot>)";
  const std::string other = with_mesh_names(urdf, {{"package://p/a & b.stl", "b-2.stl"}});
  EXPECT_THAT(other, HasSubstr("filename=\"b-2.stl\" scale=\"2 2 2\""));
  EXPECT_THAT(other, HasSubstr("filename=\"package://p/a.dae\""));
  EXPECT_EQ(with_mesh_names("<robot", {{"a", "b"}}), "<robot");
}

}  // namespace
}  // namespace armloom
