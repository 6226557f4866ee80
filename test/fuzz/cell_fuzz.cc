#include "core/model/cell/cell_checks.h"
#include "server/codec/cell_codec.h"
#include "server/messages/scene.h"
#include "test/fuzz/problems.h"

// Fuzzes the body of POST /scene/objects and a cell file: parsing, checks that need no robot, and
// rewriting paths for another folder.

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armloom;
  const std::string text = fuzz::text_of(data, size);
  if (const auto object = read_object_text(text, {}); !object) {
    fuzz::demand_readable(object.error());
  }
  const auto cell = read_cell_text(text, "/nowhere/config");
  if (!cell) {
    fuzz::demand_readable(cell.error());
    return 0;
  }
  Diagnostics diagnostics;
  check_names(*cell, diagnostics);
  check_objects(*cell, diagnostics);
  check_settings(*cell, diagnostics);
  for (const RobotDescription& robot : cell->robots) {
    check_pose(robot.X_WB, "/robots", "robot", diagnostics);
  }
  const std::size_t count = diagnostics.count();
  const Problems problems = diagnostics.take();
  fuzz::demand((count == 0) == problems.empty());
  if (!problems.empty()) fuzz::demand_readable(problems);

  const std::string moved =
      with_cell_paths(text, "/nowhere/config",
                      [](const std::filesystem::path& path) { return "copies" + path.string(); });
  const auto copy_of = [](const std::string& path) {
    return path.empty() ? path : "/nowhere/recording/copies" + path;
  };
  const auto again = read_cell_text(moved, "/nowhere/recording");
  fuzz::demand(again.has_value());
  fuzz::demand(again->robots.size() == cell->robots.size());
  for (std::size_t r = 0; r < cell->robots.size(); ++r) {
    fuzz::demand(again->robots[r].urdf == copy_of(cell->robots[r].urdf));
    fuzz::demand(again->robots[r].srdf == copy_of(cell->robots[r].srdf));
    fuzz::demand(again->robots[r].joint_limits == copy_of(cell->robots[r].joint_limits));
  }
  return 0;
}
