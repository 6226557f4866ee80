#include "test/model/test_cells.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "test/source_dir.h"

namespace armloom {
namespace {

std::string all_of(const Problems& problems) {
  std::string text;
  for (const auto& problem : problems) text += problem.pointer + " | " + problem.detail + "\n";
  return text;
}

RobotDescription panda(const std::string& name, double x, double yaw) {
  RobotDescription robot;
  robot.name = name;
  robot.urdf = model_file("panda.urdf");
  robot.srdf = model_file("panda.srdf");
  robot.prefix = name + "_";
  robot.X_WB = Eigen::Translation3d(x, 0, 0.1) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  robot.arms.push_back({name, "panda_arm", {0, -1.2, 0, -2.6, 0, 1.6, 0.785}, {}, {}});
  return robot;
}

}  // namespace

std::string data_file(const std::string& name) { return source_dir() + "/test/model/data/" + name; }
std::string model_file(const std::string& name) { return source_dir() + "/models/" + name; }

CellDescription two_arms_description() {
  RobotDescription robot;
  robot.name = "twin";
  robot.urdf = data_file("two_arms.urdf");
  robot.srdf = data_file("two_arms.srdf");
  robot.prefix = "t_";
  robot.X_WB = Eigen::Translation3d(1, -2, 0.5) *
               Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  robot.packages = {{"shapes", data_file("shapes")}};
  robot.arms.push_back({"left", "left_arm", {0.3, -0.5}, {}, {}});
  robot.arms.push_back({"right", "right_arm", {}, {}, {}});
  CellDescription cell;
  cell.name = "two_arms";
  cell.robots.push_back(robot);
  cell.objects.push_back({"table", Box{{2, 2, 0.1}}, Eigen::Isometry3d::Identity()});
  return cell;
}

CellDescription two_pandas_description() {
  CellDescription cell;
  cell.name = "two_pandas";
  cell.robots = {panda("left", -0.4, 0.0), panda("right", 0.4, -std::numbers::pi)};
  cell.objects.push_back(
      {"table", Box{{2, 2, 0.1}}, Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.05))});
  cell.allowed_collisions = {{"table", "left_panda_link0"}, {"right_panda_link0", "table"}};
  return cell;
}

CellPtr build_or_fail(const CellDescription& description) {
  auto cell = build_cell(description);
  if (!cell) throw std::runtime_error(all_of(cell.error()));
  return *cell;
}

std::string problems_of(const CellDescription& description) {
  const auto cell = build_cell(description);
  return cell ? "" : all_of(cell.error());
}

std::string warnings_of(const CellDescription& description) {
  Problems warnings;
  const auto cell = build_cell(description, warnings);
  if (!cell) throw std::runtime_error(all_of(cell.error()));
  return all_of(warnings);
}

ScratchFolder::ScratchFolder() {
  std::string name = ::testing::TempDir() + "armloom_model_XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no scratch folder");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string ScratchFolder::write(const std::string& name, const std::string& text) const {
  const auto file = path_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
  return file.string();
}

std::string file_with(const std::string& path, const std::string& from, const std::string& to) {
  std::ostringstream read;
  read << std::ifstream(path).rdbuf();
  std::string text = read.str();
  const auto found = text.find(from);
  if (found == std::string::npos || text.find(from, found + 1) != std::string::npos) {
    throw std::runtime_error("'" + from + "' is not exactly once in " + path);
  }
  return text.replace(found, from.size(), to);
}

std::string without_lines(const std::string& text) {
  static const std::regex line("(\\.(?:urdf|srdf)):[0-9]+: ");
  return std::regex_replace(text, line, "$1: ");
}

int line_of(const std::string& place) {
  static const std::regex line("\\.(?:urdf|srdf):([0-9]+)(?:: .*)?");
  std::smatch found;
  return std::regex_search(place, found, line) ? std::stoi(found[1]) : 0;
}

int line_of_change(const std::string& before, const std::string& after) {
  const auto until = std::ranges::mismatch(before, after).in1;
  return 1 + static_cast<int>(std::count(before.begin(), until, '\n'));
}

}  // namespace armloom
