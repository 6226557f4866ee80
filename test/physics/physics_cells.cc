#include "test/physics/physics_cells.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "test/source_dir.h"

namespace armloom::test {
namespace {

std::filesystem::path config_folder() { return std::filesystem::path(source_dir()) / "config"; }

}  // namespace

CellPtr cell_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  const auto description = read_cell_text(text.str(), file.parent_path());
  if (!description) throw std::runtime_error(description.error().front().detail);
  const auto cell = build_cell(*description);
  if (!cell) throw std::runtime_error(cell.error().front().detail);
  return *cell;
}

CellPtr config_cell(const std::string& name) { return cell_in(config_folder() / (name + ".json")); }

std::vector<std::string> config_cell_names() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(config_folder())) {
    const std::string stem = file.path().stem().string();
    if (file.path().extension() != ".json" || stem.ends_with("_jobs") || stem == "cell.schema") {
      continue;
    }
    names.push_back(stem);
  }
  std::sort(names.begin(), names.end());
  return names;
}

Configuration random_configuration(const Cell& cell, std::mt19937_64& random) {
  Configuration q(static_cast<Eigen::Index>(cell.joints.size()));
  for (std::size_t j = 0; j < cell.joints.size(); ++j) {
    const Joint& joint = cell.joints[j];
    q[static_cast<Eigen::Index>(j)] =
        std::uniform_real_distribution<double>(joint.lower, joint.upper)(random);
  }
  return q;
}

}  // namespace armloom::test
