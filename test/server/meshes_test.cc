#include <gtest/gtest.h>

#include <fstream>

#include "server/messages/mesh_address.h"
#include "test/geometry/small_meshes.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kUrdf = R"(<robot name="r"><link name="l">
  <visual><geometry><mesh filename="package://p/look.DAE"/></geometry></visual>
  <visual><geometry><mesh filename="package://p/gone.dae"/></geometry></visual>
  <visual><geometry><mesh filename="package://p/secret.txt"/></geometry></visual>
  <collision><geometry><mesh filename="package://p/part.stl"/></geometry></collision>
</link><link name="tip"/><joint name="j" type="revolute"><parent link="l"/><child link="tip"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>)";
constexpr const char* kSrdf =
    R"(<robot name="r"><group name="g"><joint name="j"/></group></robot>)";
constexpr const char* kCell =
    R"({"name": "m", "robots": [{"name": "r", "urdf": "r.urdf", "srdf": "r.srdf",
  "packages": {"p": "package"}, "arms": [{"name": "r", "group": "g"}]}],
  "objects": [{"name": "crate", "mesh": "crate.obj", "scale": [1, 2, 0.5], "xyz": [5, 0, 0]}]})";

class MeshRoutes : public test::RunningServer {
 protected:
  MeshRoutes()
      : folder_(fs::path(::testing::TempDir()) / "armloom-meshes" /
                ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "package");
    write("r.urdf", kUrdf);
    write("r.srdf", kSrdf);
    write("package/part.stl", small::stl_bytes(box_));
    write("package/look.DAE", "<COLLADA/>");
    write("package/secret.txt", "secret");
    write("crate.obj", small::obj_text(box_));
    write("cell.json", kCell);
  }
  void write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }

  fs::path folder_;
  const small::Surface box_ = small::box_surface({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
};

TEST_F(MeshRoutes, ServeTheMeshesOfTheCell) {
  start(1.0, {}, folder_ / "cell.json");
  const json cell = get("/api/v1/cell").json();
  const json meshes = cell["robots"][0]["meshes"];
  ASSERT_EQ(meshes.size(), 2U) << meshes;
  const auto part = get(meshes["package://p/part.stl"].get<std::string>());
  EXPECT_EQ(part.status, 200);
  EXPECT_EQ(part.body, small::stl_bytes(box_));
  EXPECT_EQ(part.headers.at("content-type"), "model/stl");
  const auto look = get(meshes["package://p/look.DAE"].get<std::string>());
  EXPECT_EQ(look.body, "<COLLADA/>");
  EXPECT_EQ(look.headers.at("content-type"), "model/vnd.collada+xml");
  EXPECT_EQ(cell["objects"][0]["scale"], json::array({1, 2, 0.5}));
  const auto crate = get(cell["objects"][0]["mesh"].get<std::string>());
  EXPECT_EQ(crate.body, small::obj_text(box_));
  EXPECT_EQ(crate.headers.at("content-type"), "model/obj");
  EXPECT_EQ(get("/api/v1/scene").json()["objects"], cell["objects"]);
}

TEST_F(MeshRoutes, ServeNoOtherFileAndRevealNoPath) {
  start(1.0, {}, folder_ / "cell.json");
  for (const std::string& path :
       {std::string("../cell.json"), std::string("r.urdf"), folder_.string(),
        std::string("package%2fsecret.txt"), std::string("0000000000000000.stl"),
        mesh_name((folder_ / "package/secret.txt").string()), std::string("")}) {
    const auto answer = get(kMeshFolder + path);
    EXPECT_TRUE(answer.status == 404 || answer.status == 400) << path << ": " << answer.status;
    EXPECT_EQ(answer.body.find("secret\""), std::string::npos);
  }
  EXPECT_EQ(get("/api/v1/cell").body.find(folder_.string()), std::string::npos);
}

TEST_F(MeshRoutes, ReportAMissingMesh) {
  start(1.0, {}, folder_ / "cell.json");
  const std::string address =
      get("/api/v1/cell").json()["robots"][0]["meshes"]["package://p/part.stl"];
  fs::remove(folder_ / "package/part.stl");
  EXPECT_EQ(get(address).status, 404);
}

TEST_F(MeshRoutes, DoNotFollowLinksCreatedAfterTheStart) {
  write("elsewhere.stl", "elsewhere");
  start(1.0, {}, folder_ / "cell.json");
  const std::string address =
      get("/api/v1/cell").json()["robots"][0]["meshes"]["package://p/part.stl"];
  fs::remove(folder_ / "package/part.stl");
  fs::create_symlink(folder_ / "elsewhere.stl", folder_ / "package/part.stl");
  EXPECT_EQ(get(address).status, 404);
  // The mesh must not be served either if its folder has become a link.
  fs::remove(folder_ / "package/part.stl");
  write("package/part.stl", small::stl_bytes(box_));
  EXPECT_EQ(get(address).status, 200);
  fs::create_directories(folder_ / "other");
  fs::copy(folder_ / "package/part.stl", folder_ / "other/part.stl");
  fs::rename(folder_ / "package", folder_ / "was");
  fs::create_directory_symlink(folder_ / "other", folder_ / "package");
  EXPECT_EQ(get(address).status, 404);
}

TEST_F(MeshRoutes, AreNotSentAgainIfTheETagMatches) {
  start(1.0, {}, folder_ / "cell.json");
  const std::string address =
      get("/api/v1/cell").json()["robots"][0]["meshes"]["package://p/part.stl"];
  const std::string tag = get(address).headers.at("etag");
  test::Wire wire(port());
  wire.send("GET " + address +
            " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nIf-None-Match: " + tag +
            "\r\n\r\n");
  EXPECT_TRUE(wire.take_all().starts_with("HTTP/1.1 304 "));
}

}  // namespace
}  // namespace armloom
