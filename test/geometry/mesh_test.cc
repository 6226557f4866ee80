#include <gmock/gmock.h>

#include <chrono>
#include <random>

#include "test/geometry/mesh_file.h"

// assimp 5.2 leaks about a kilobyte per file that it rejects.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }

namespace armloom {
namespace {

using testing::HasSubstr;

constexpr const char* kPlaced = R"(<node><instance_geometry url="#g"/></node>)";

TEST_F(MeshFile, LoadsTheSameBoxFromEachFormat) {
  for (const auto& mesh :
       {load("a.stl", small::stl_text(box_)), load("b.STL", small::stl_bytes(box_)),
        load("c.obj", small::obj_text(box_)), load("d.dae", small::dae_text(box_, "", kPlaced))}) {
    EXPECT_EQ(mesh->vertices.size(), 8U);
    EXPECT_EQ(mesh->triangles.size(), 12U);
    expect_bounds(*mesh, {-0.1, -0.2, 0.5}, {0.3, 0.4, 0.75});
    EXPECT_NEAR(std::abs(volume(mesh->vertices, mesh->triangles)), 0.4 * 0.6 * 0.25, 1e-7);
  }
}

TEST_F(MeshFile, IsScaledAndMirroredAlongEachAxis) {
  const MeshPtr mesh = load("a.stl", small::stl_bytes(box_), {2.0, -1.0, 0.001});
  expect_bounds(*mesh, {-0.2, -0.4, 0.0005}, {0.6, 0.2, 0.00075});
}

TEST_F(MeshFile, ConvertsColladaUnitsToMeters) {
  const MeshPtr mesh =
      load("a.dae", small::dae_text(box_, R"(<unit name="centimeter" meter="0.01"/>)", kPlaced));
  expect_bounds(*mesh, {-0.001, -0.002, 0.005}, {0.003, 0.004, 0.0075});
}

TEST_F(MeshFile, AppliesColladaNodeTransforms) {
  const std::string scene = R"(<node><translate>1 0 0</translate>
    <node><rotate>0 0 1 90</rotate><instance_geometry url="#g"/></node>
    <node><translate>0 0 -2</translate><instance_node url="#n"/></node></node>)";
  const std::string nodes = R"(<node id="n"><instance_geometry url="#g"/></node>)";
  const MeshPtr mesh = load("a.dae", small::dae_text(box_, "", scene, nodes));
  EXPECT_EQ(mesh->triangles.size(), 24U);
  // Rotated instance: x from -0.4 to 0.2, y from -0.1 to 0.3, moved by 1 along x. Other instance: 2
  // m lower.
  expect_bounds(*mesh, {0.6, -0.2, -1.5}, {1.3, 0.4, 0.75});
}

TEST_F(MeshFile, IgnoresTheColladaUpAxis) {
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
    expect_bounds(*load("a.dae", small::dae_text(box_, "", kPlaced, "", up)), {-0.1, -0.2, 0.5},
                  {0.3, 0.4, 0.75});
  }
}

TEST_F(MeshFile, TriangulatesPolygons) {
  const MeshPtr mesh =
      load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\n");
  EXPECT_EQ(mesh->triangles.size(), 3U);
}

TEST_F(MeshFile, AcceptsNumbersWithoutLeadingZero) {
  const MeshPtr mesh = load("a.obj", "v .1 0 -.2\nv\t.3 1. 0\n v 0 .5 .25\nf 1 2 3\n");
  expect_bounds(*mesh, {0.0, 0.0, -0.2}, {0.3, 1.0, 0.25});
}

TEST_F(MeshFile, RejectsASinglePointAndDetectsFlatMeshes) {
  const Problem point = refusal("a.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n");
  EXPECT_EQ(point.slug, "mesh-without-extent");
  EXPECT_THAT(point.detail, HasSubstr("1 triangles is the same point 1 2 3"));
  EXPECT_TRUE(is_flat(*load("b.obj", "v 0 0 0\nv 1 0 1\nv 0 1 1\nf 1 2 3\n")));
  EXPECT_TRUE(is_flat(*load("c.obj", "v 0 0 0\nv 1 0 1\nv 2 0 2\nf 1 2 3\n")));
  EXPECT_FALSE(is_flat(*load("d.stl", small::stl_bytes(box_))));
}

TEST_F(MeshFile, ReportsWhyItCannotBeRead) {
  const auto says = [&](const Problem& problem, const char* slug, const std::string& why) {
    EXPECT_EQ(problem.slug, slug);
    EXPECT_EQ(problem.pointer, "/here");
    EXPECT_THAT(problem.detail,
                testing::AllOf(testing::StartsWith("robot a: mesh /"), HasSubstr(why)));
    EXPECT_NE(problem.value.index(), 0U);
  };
  says(refusal((folder_.path() / "none.stl").string()), "file-missing", "there is no such file");
  says(refusal(folder_.path().string() + "/."), "mesh-format", "only .stl, .obj and .dae");
  says(refusal("a.ply", "ply"), "mesh-format", "only .stl, .obj and .dae");
  std::filesystem::create_directory(folder_.path() / "folder.stl");
  says(refusal((folder_.path() / "folder.stl").string()), "file-unreadable", "not a regular file");
  says(refusal("empty.stl", ""), "mesh-empty", "the file is empty");
  says(refusal("none.stl", "solid a\nendsolid a\n"), "mesh-empty", "it holds no triangle");
  says(refusal("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "mesh-empty", "it holds no triangle");
  says(refusal("broken.dae", "<COLLADA><asset>"), "mesh-unreadable", "it is not well-formed XML");
  says(refusal("other.dae", "<robot/>"), "mesh-unreadable", "not <COLLADA>");
  const std::string dae = small::dae_text(box_, "", kPlaced);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = dae;
    return refusal("changed.dae", changed.replace(changed.find(from), from.size(), to));
  };
  says(with("<p>0 2 3", "<p>0 x 3"), "mesh-unreadable",
       "<p> holds 'x', which is not a valid index");
  says(with("<p>0 2 3", "<p>0 2 8"), "mesh-unreadable",
       "<p> holds index 8, the sources have 8 elements");
  says(with("<p>0 2 3", "<p>"), "mesh-unreadable",
       "<triangles>: its count does not match its content");
  says(with("count=\"24\"", "count=\"25\""), "mesh-unreadable",
       "states a count of 25 but holds 24 numbers");
  says(with("count=\"8\"", "count=\"9\""), "mesh-unreadable", "asks for more than its array holds");
  says(with("stride=\"3\"", "stride=\"2\""), "mesh-unreadable",
       "asks for more than its array holds");
  says(with("offset=\"0\"", "offset=\"-1\""), "mesh-unreadable", "<input>");
  says(with("<instance_geometry", "<skew>1 2 3</skew><instance_geometry"), "mesh-unreadable",
       "<skew> is not supported");
  says(with("<instance_geometry url=\"#g\"", "<instance_controller url=\"#c\""), "mesh-unreadable",
       "<instance_controller> is not supported");
  says(refusal("short.stl", small::stl_bytes(box_).substr(0, 200)), "mesh-unreadable", "stl");
}

TEST_F(MeshFile, ReportsVerticesThatAreNotFinite) {
  small::Surface bad = box_;
  bad.vertices[3].y() = std::nan("");
  EXPECT_THAT(refusal("nan.stl", small::stl_bytes(bad)).detail, HasSubstr(": y is nan"));
  EXPECT_THAT(refusal("nan_text.stl", small::stl_text(bad)).detail, HasSubstr(": y is nan"));
  bad.vertices[3].y() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal("inf.stl", small::stl_bytes(bad)).detail, HasSubstr(": y is inf"));
  bad.vertices[3].y() = -2000.0;
  EXPECT_THAT(refusal("far.stl", small::stl_bytes(bad)).detail,
              HasSubstr("y is -2000 m, at most 1000 m"));
}

TEST_F(MeshFile, RejectsAMillionTrianglesQuickly) {
  const auto start = std::chrono::steady_clock::now();
  std::string stl(84 + 50'000'000, '\0');
  const std::uint32_t million = 1'000'000;
  std::memcpy(stl.data() + 80, &million, sizeof million);
  EXPECT_THAT(refusal("a.stl", stl).detail, HasSubstr("it has 1000000 triangles, at most 500000"));
  EXPECT_THAT(refusal("lie.stl", small::stl_bytes(box_, 4'000'000'000U)).detail,
              HasSubstr("4000000000 triangles"));
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 1'000'000; ++i) obj += "f 1 2 3\n";
  EXPECT_THAT(refusal("a.obj", obj).detail, HasSubstr("it has 1000000 triangles"));
  std::string fan = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (int i = 0; i < 1'000'002; ++i) fan += " 1";
  EXPECT_THAT(refusal("fan.obj", fan).detail, HasSubstr("it has 1000000 triangles"));
  small::Surface many = box_;
  many.triangles.assign(1'000'000, {0, 1, 2});
  EXPECT_THAT(refusal("a.dae", small::dae_text(many, "", kPlaced)).detail,
              HasSubstr("it has 1000000 triangles"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST_F(MeshFile, RejectsFilesOver64MebibytesUnread) {
  const std::string path = folder_.write("big.stl", "solid");
  std::filesystem::resize_file(path, kMaxMeshBytes + 1);
  EXPECT_THAT(refusal(path).detail, HasSubstr("67108865 bytes, at most 67108864"));
}

TEST_F(MeshFile, RejectsExponentialAndCyclicNodeInstances) {
  std::string nodes = R"(<node id="n0"><instance_geometry url="#g"/></node>)";
  for (int i = 1; i <= 60; ++i) {
    const std::string below = R"(<instance_node url="#n)" + std::to_string(i - 1) + R"("/>)";
    nodes += R"(<node id="n)" + std::to_string(i) + R"(">)" + below + below + "</node>";
  }
  const std::string scene = R"(<node><instance_node url="#n60"/></node>)";
  EXPECT_EQ(refusal("bomb.dae", small::dae_text(box_, "", scene, nodes)).slug, "mesh-too-large");
  const std::string ring =
      R"(<node id="a"><instance_node url="#b"/></node><node id="b"><instance_node url="#a"/></node>)";
  EXPECT_THAT(refusal("ring.dae",
                      small::dae_text(box_, "", R"(<node><instance_node url="#a"/></node>)", ring))
                  .detail,
              HasSubstr("its nodes instance each other in a cycle"));
}

// Truncated, overwritten and duplicated files are read or rejected with a reason.
TEST_F(MeshFile, SurvivesBrokenBytes) {
  std::mt19937_64 random(3);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const std::string nodes = R"(<node id="n"><instance_geometry url="#g"/></node>)";
  const std::pair<const char*, std::string> sound[] = {
      {"a.stl", small::stl_bytes(box_)},
      {"b.stl", small::stl_text(box_)},
      {"c.obj", small::obj_text(box_)},
      {"d.dae", small::dae_text(box_, "", R"(<node><instance_node url="#n"/></node>)", nodes)}};
  int refused = 0;
  for (int round = 0; round < 400; ++round) {
    for (const auto& [name, whole] : sound) {
      std::string bytes = whole;
      for (std::size_t i = 0; i <= below(3); ++i) {
        const std::size_t at = below(bytes.size());
        const std::size_t length = std::min(below(20) + 1, bytes.size() - at);
        switch (below(4)) {
          case 0:
            bytes.resize(at + 1);
            break;
          case 1:
            bytes.insert(at, bytes.substr(at, length));
            break;
          case 2:
            bytes[at] = static_cast<char>(below(256));
            break;
          default:
            bytes.replace(at, length, std::to_string(random()));
            break;
        }
      }
      const auto mesh = load_mesh(folder_.write(name, bytes), kOne, "/here", "robot a");
      refused += mesh ? 0 : 1;
      if (!mesh) {
        EXPECT_FALSE(mesh.error().front().detail.empty());
        continue;
      }
      for (const Triangle& t : (*mesh)->triangles) {
        for (const std::uint32_t i : t) ASSERT_LT(i, (*mesh)->vertices.size());
      }
      for (const Eigen::Vector3d& p : (*mesh)->vertices)
        ASSERT_LE(p.cwiseAbs().maxCoeff(), kMaxMeshReach_m);
      EXPECT_FALSE((*mesh)->hull.faces.empty());
    }
  }
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace armloom
