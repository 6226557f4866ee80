#include "server/recording/cell_copy.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/recording/recording.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

class CellCopy : public ::testing::Test {
 protected:
  CellCopy() : folder_(fs::path(::testing::TempDir()) / "armloom" / "cell_copy") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~CellCopy() override { fs::remove_all(folder_); }

  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "files"))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  fs::path folder_;
};

CellFile cell_file(const fs::path& file) { return {file, read_text_file(file).value()}; }

TEST_F(CellCopy, ContainsEachFileOnceAndLoads) {
  const fs::path shuttle = fs::path(source_dir()) / "models/shuttle";
  const auto copy =
      copy_cell(cell_file(fs::path(source_dir()) / "config/two_shuttles.json"), folder_);
  ASSERT_TRUE(copy);
  std::size_t meshes = 0;
  for (const auto& entry : fs::directory_iterator(shuttle / "meshes"))
    if (entry.is_regular_file()) ++meshes;
  EXPECT_EQ(files().size(), meshes + 3) << ::testing::PrintToString(files());
  const auto cell = read_cell_text(*copy, folder_);
  ASSERT_TRUE(cell);
  EXPECT_EQ(cell->robots[0].urdf, (folder_ / "files/shuttle.urdf").string());
  EXPECT_EQ(cell->robots[1].urdf, cell->robots[0].urdf);
  EXPECT_TRUE(build_cell(*cell));
}

TEST_F(CellCopy, OfACopyIntoItsOwnFolderChangesNothing) {
  const auto copy =
      copy_cell(cell_file(fs::path(source_dir()) / "config/two_shuttles.json"), folder_);
  ASSERT_TRUE(copy);
  const auto before = files();
  const auto again = copy_cell({folder_ / "cell.json", *copy}, folder_);
  ASSERT_TRUE(again) << again.error().front().detail;
  EXPECT_EQ(*again, *copy);
  EXPECT_EQ(files(), before);
}

TEST_F(CellCopy, KeepsFilesWithTheSameNameApart) {
  write("a/meshes/arm.stl", "solid of a");
  write("b/meshes/arm.stl", "solid of b");
  write("site/arm.urdf",
        R"(<robot name="r"><link name="l">
<visual><geometry><mesh filename="package://a/meshes/arm.stl"/></geometry></visual>
<collision><geometry><mesh filename="package://b/meshes/arm.stl"/></geometry></collision>
</link></robot>)");
  write("site/arm.srdf", "<robot name=\"r\"/>");
  write("site/cell.json", R"({"name": "c", "robots": [{"name": "r", "urdf": "arm.urdf",
    "srdf": "arm.srdf", "packages": {"a": "../a", "b": "../b"}, "arms": [{"name": "a", "group": "g"}]}]})");
  const auto copy = copy_cell(cell_file(folder_ / "site/cell.json"), folder_);
  ASSERT_TRUE(copy) << copy.error().front().detail;
  EXPECT_THAT(files(), ::testing::ElementsAre("arm-2.stl", "arm.srdf", "arm.stl", "arm.urdf"));
  EXPECT_EQ(read_text_file(folder_ / "files/arm.stl").value(), "solid of a");
  EXPECT_EQ(read_text_file(folder_ / "files/arm-2.stl").value(), "solid of b");
  const std::string urdf = read_text_file(folder_ / "files/arm.urdf").value();
  EXPECT_LT(urdf.find("\"arm.stl\""), urdf.find("\"arm-2.stl\""));
}

TEST_F(CellCopy, ReportsAFileThatCannotBeCopied) {
  write("files", "in the way");
  const auto copy =
      copy_cell(cell_file(fs::path(source_dir()) / "config/two_shuttles.json"), folder_);
  ASSERT_FALSE(copy);
  EXPECT_EQ(copy.error().front().kind, ProblemKind::unavailable);
  EXPECT_THAT(copy.error().front().detail, ::testing::HasSubstr((folder_ / "files").string()));
}

}  // namespace
}  // namespace armloom
