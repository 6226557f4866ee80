#include <gmock/gmock.h>

#include <map>

#include "core/geometry/mesh/mesh.h"
#include "core/model/cell/build_cell.h"
#include "test/geometry/small_meshes.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

using testing::HasSubstr;

const small::Surface kBox = small::box_surface({-0.1, -0.2, 0.5}, {0.3, 0.4, 0.75});

class WholeMesh : public testing::Test {
 protected:
  Result<MeshPtr> load(const std::string& name, const std::string& bytes) {
    return load_mesh(folder_.write(name, bytes), Eigen::Vector3d::Ones(), "/here", "robot a");
  }
  void expect_box(const std::string& name, const std::string& bytes) {
    const auto mesh = load(name, bytes);
    ASSERT_TRUE(mesh.has_value()) << mesh.error().front().detail;
    EXPECT_EQ((*mesh)->triangles.size(), 12U);
    EXPECT_EQ((*mesh)->open_edges, 0U);
    EXPECT_NE((*mesh)->surface, nullptr);
  }
  void expect_refused(const std::string& name, const std::string& bytes, const std::string& why) {
    const auto mesh = load(name, bytes);
    ASSERT_FALSE(mesh.has_value()) << bytes;
    EXPECT_THAT(mesh.error().front().detail, HasSubstr(why));
    EXPECT_THAT(mesh.error().front().detail, HasSubstr(name));
  }

  ScratchFolder folder_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(WholeMesh, RejectsTruncatedTextStl) {
  const std::string whole = small::stl_text(kBox);
  const std::size_t end = whole.find("endsolid") + 8;
  for (std::size_t size = 1; size < end; size += 3) {
    const auto mesh = load("cut.stl", whole.substr(0, size));
    ASSERT_FALSE(mesh.has_value()) << size;
    ASSERT_THAT(mesh.error().front().detail,
                testing::AnyOf(HasSubstr("line "), HasSubstr("not an STL")));
  }
  expect_box("name_cut.stl", whole.substr(0, end + 3));
  expect_refused("cut.stl", whole.substr(0, whole.find("endfacet") + 9),
                 "line 9: expected 'facet' or 'endsolid', but the file ends: it was cut off");
}

TEST_F(WholeMesh, RejectsMisspelledWordsInTextStl) {
  const std::string whole = small::stl_text(kBox);
  const std::map<std::string, std::string> words{{"facet normal", "facte normal"},
                                                 {"normal", "nomal"},
                                                 {"outer", "inner"},
                                                 {"loop", "lop"},
                                                 {"  vertex", "  vertx"},
                                                 {"endloop", "endlop"},
                                                 {"endfacet", "endfact"},
                                                 {"endsolid", "endsold"},
                                                 {"0.5", "0,5"},
                                                 {"0.75", "abc"},
                                                 {" 0.5\n", "\n"}};
  for (const auto& [word, other] : words) {
    expect_refused("odd.stl", replaced(whole, word, other), ": line ");
  }
  expect_refused("odd.stl", replaced(whole, "facet normal", "facte normal"),
                 "line 2: expected 'facet' or 'endsolid', found 'facte'");
  expect_refused("odd.stl", replaced(whole, "0.5\n", "0,5\n"),
                 "line 4: expected a number, found '0,5'");
  expect_refused("odd.stl", replaced(whole, " endloop", "  vertex 0 0 0\n endloop"),
                 "line 7: a facet has more than three corners");
  expect_refused("odd.stl", whole + "facet", "expected 'solid', found 'facet'");
}

TEST_F(WholeMesh, AcceptsVariantsOfTextStl) {
  const std::string whole = small::stl_text(kBox);
  std::string upper = whole;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  expect_box("upper.stl", upper);
  std::string crlf;
  for (const char c : whole) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  expect_box("crlf.stl", crlf);
  expect_box("unnamed.stl",
             replaced(replaced(whole, "solid part", "solid"), "endsolid part\n", "endsolid"));
  expect_box("words.stl", replaced(whole, "solid part", "solid facet of a normal part"));
  expect_box("normals.stl", replaced(whole, "normal 0 0 0", "normal nan -1.#IND 1e-400"));
  const auto mesh =
      load("two.stl", whole + small::stl_text(small::box_surface({5, 5, 5}, {6, 6, 6})));
  ASSERT_TRUE(mesh.has_value());
  EXPECT_EQ((*mesh)->triangles.size(), 24U);
}

TEST_F(WholeMesh, RequiresBinaryStlLengthToMatchItsCount) {
  const std::string whole = small::stl_bytes(kBox);
  expect_box("a.stl", whole);
  expect_box("solid.stl", "solid" + whole.substr(5));
  for (const std::size_t size : {83U, 84U, 134U, 683U}) {
    expect_refused("cut.stl", whole.substr(0, size), "not an STL");
    expect_refused("cut.stl", "solid" + whole.substr(5, size - 5), "");
  }
  expect_refused("cut.stl", whole.substr(0, 634),
                 "its header announces 12 triangles (684 bytes), but it has 634 bytes: it was cut "
                 "off");
  expect_refused("more.stl", whole + std::string(50, '\0'), "it holds more than it says");
}

TEST_F(WholeMesh, RejectsUnknownWordsAndCornersInObj) {
  const std::string whole = small::obj_text(kBox);
  expect_box("a.obj", whole);
  const std::map<std::string, std::string> words{
      {"v -0.1", "vv -0.1"},   {"f 1", "ff 1"},           {"f 1 3 4", "f 1 3"},
      {"f 1 3 4", "f 1 x 4"},  {"f 1 3 4", "f 1 0 4"},    {"f 1 3 4", "f 1 3 9"},
      {"f 1 3 4", "f 1 3 -9"}, {"v -0.1", "v"},           {"v -0.1", "v x"},
      {"v -0.1", "v 0 0"},     {"f 1 3 4", "surf 0 1 2"}, {"f 1 3 4", "f 1/1/1/1 3 4"}};
  for (const auto& [word, other] : words) {
    expect_refused("odd.obj", replaced(whole, word, other), ": line ");
  }
  expect_refused("odd.obj", replaced(whole, "f 1 3 4", "f 1 3 9"),
                 "line 10: a face names vertex 9, but the file has 8 vertices: was it cut off?");
  expect_refused("cut.obj", whole.substr(0, whole.size() - 4), "not 3 or more");
}

TEST_F(WholeMesh, AcceptsVariantsOfObj) {
  const std::string whole = small::obj_text(kBox);
  expect_box("slashes.obj", replaced(replaced(whole, "f 1 3 4", "f 1//1 3/2/ 4/5/6"), "f ", "f  "));
  expect_box("back.obj", replaced(whole, "f 1 3 4", "f -8 -6 -5"));
  expect_box("comment.obj", replaced(whole, "\nv ", " # a comment, 1 2 3\n  v "));
  expect_box("colour.obj", replaced(whole, "0.5\n", "5e-1 1 0 0.3 # 9\n"));
  expect_box("long.obj", replaced(whole, "f 1 3 4",
                                  "o part\ng x y\nusemtl z\nvt 0 0\nvn 0 0 1\ns off\nf 1 3\\\n 4"));
  // A 3 mm pentagon, as in small parts.
  std::string nut =
      "v 0.003 0 0\nv 0.001 0.003 0\nv -0.002 0.002 0\nv -0.002 -0.002 0\nv 0.001 -0.003 0\n"
      "v 0 0 0.001\nf 1 2 3 4 5\nf 2 1 6\nf 3 2 6\nf 4 3 6\nf 5 4 6\nf 1 5 6\n";
  const auto mesh = load("nut.obj", nut);
  ASSERT_TRUE(mesh.has_value()) << mesh.error().front().detail;
  EXPECT_EQ((*mesh)->triangles.size(), 8U);
  EXPECT_EQ((*mesh)->open_edges, 0U);
}

// ---- Open meshes ----

TEST_F(WholeMesh, OpenMeshIsReplacedByItsHullWithAWarning) {
  small::Surface open = kBox;
  open.triangles.pop_back();
  const std::string path = folder_.write("open.stl", small::stl_text(open));
  const auto mesh = load_mesh(path, Eigen::Vector3d::Ones(), "/here", "robot a");
  ASSERT_TRUE(mesh.has_value());
  EXPECT_EQ((*mesh)->open_edges, 3U);
  EXPECT_EQ((*mesh)->surface, nullptr);
  EXPECT_EQ((*mesh)->pieces.size(), 1U);

  CellDescription cell = two_pandas_description();
  cell.objects.push_back({"crate", Mesh{path}, Eigen::Isometry3d(Eigen::Translation3d(0, 3, 0))});
  cell.objects.push_back({"other", Mesh{path}, Eigen::Isometry3d(Eigen::Translation3d(0, 5, 0))});
  Problems warnings;
  ASSERT_TRUE(build_cell(cell, warnings).has_value());
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings.front().slug, "open-mesh");
  EXPECT_THAT(warnings.front().detail,
              testing::AllOf(HasSubstr("object crate: mesh " + path), HasSubstr(" 3 edges "),
                             HasSubstr("its convex hull is checked")));
}

// ---- Two-sided faces ----

small::Surface turned(small::Surface surface) {
  for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

TEST_F(WholeMesh, RemovesDuplicateFacesOfATwoSidedSolid) {
  expect_box("two.stl", small::stl_text(small::joined(kBox, turned(kBox))));
  expect_box("four.stl", small::stl_text(small::joined(small::joined(kBox, turned(kBox)),
                                                       small::joined(turned(kBox), kBox))));
  small::Surface mixed{kBox.vertices, {}};
  for (std::size_t i = 0; i < kBox.triangles.size(); ++i) {
    for (const bool other : {i % 2 == 0, i % 2 != 0}) {
      Triangle t = kBox.triangles[i];
      if (other) std::swap(t[1], t[2]);
      mixed.triangles.push_back(t);
    }
  }
  expect_box("mixed.stl", small::stl_text(mixed));
  const auto beside =
      load("beside.stl", small::stl_text(small::joined(small::joined(kBox, turned(kBox)),
                                                       small::box_surface({5, 5, 5}, {6, 6, 6}))));
  ASSERT_TRUE(beside.has_value());
  EXPECT_EQ((*beside)->triangles.size(), 24U);
}

TEST_F(WholeMesh, KeepsBothSidesOfSheetsAndWalls) {
  small::Surface bin = kBox;
  bin.triangles.resize(10);  // one face is open
  const auto sheets = load("bin.stl", small::stl_text(small::joined(bin, turned(bin))));
  ASSERT_TRUE(sheets.has_value());
  EXPECT_EQ((*sheets)->triangles.size(), 20U);
  EXPECT_FALSE((*sheets)->both_sides);
  const auto boxes = load(
      "boxes.stl",
      small::stl_text(small::joined(kBox, small::box_surface({0.3, -0.2, 0.5}, {0.9, 0.4, 0.75}))));
  ASSERT_TRUE(boxes.has_value());
  EXPECT_EQ((*boxes)->triangles.size(), 24U);
  EXPECT_FALSE((*boxes)->both_sides);
  EXPECT_NE((*boxes)->surface, nullptr);
}

TEST_F(WholeMesh, AmbiguousSolidUsesItsConvexPieces) {
  small::Surface fin = small::joined(kBox, turned(kBox));
  fin.vertices.emplace_back(1, 1, 1);
  fin.vertices.emplace_back(1, 1, 0);
  const auto apex = static_cast<std::uint32_t>(fin.vertices.size() - 2);
  for (const Triangle& t : {Triangle{0, 1, apex}, Triangle{1, apex, apex + 1},
                            Triangle{0, apex + 1, apex}, Triangle{0, apex + 1, 1}}) {
    fin.triangles.push_back(t);  // a tetrahedron on an edge
  }
  const auto mesh = load("fin.stl", small::stl_text(fin));
  ASSERT_TRUE(mesh.has_value());
  EXPECT_TRUE((*mesh)->both_sides);
  EXPECT_EQ((*mesh)->surface, nullptr);
  EXPECT_FALSE((*mesh)->pieces.empty());
}

}  // namespace
}  // namespace armloom
