#include <filesystem>
#include <fstream>
#include <optional>

#include "core/model/cell/build_cell.h"
#include "core/model/kinematics.h"
#include "test/fuzz/problems.h"

// Fuzzes build_cell() with a robot's URDF, SRDF and joint limits. An input is the name of the arm's
// group, a newline, the URDF, a line "=== SRDF", the SRDF, a line "=== LIMITS", the YAML; the last
// two parts are optional. The files are written to the folder ARMLOOM_FUZZ_SCRATCH (a memory file
// system, for speed).

namespace armloom::fuzz {
namespace {

namespace fs = std::filesystem;

fs::path scratch() {
  const char* folder = std::getenv("ARMLOOM_FUZZ_SCRATCH");
  return folder != nullptr ? fs::path(folder) : fs::temp_directory_path();
}

void write_file(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  demand(out.good());
}

// Cuts off the part after the separator; returns nullopt if there is no separator.
std::optional<std::string> cut_part(std::string& input, const std::string& separator) {
  const std::size_t cut = input.find(separator);
  if (cut == std::string::npos) return std::nullopt;
  std::string part = input.substr(cut + separator.size());
  input.resize(cut);
  return part;
}

CellDescription description_of(std::string input, const fs::path& folder) {
  const auto limits = cut_part(input, "\n=== LIMITS\n");
  const std::string separator = "\n=== SRDF\n";
  const std::size_t line = std::min(input.find('\n'), input.size());
  const std::size_t cut = std::min(input.find(separator, line), input.size());
  write_file(folder / "r.urdf", input.substr(line, cut - line));
  RobotDescription robot;
  robot.name = "r";
  robot.prefix = "r_";
  robot.urdf = (folder / "r.urdf").string();
  if (cut < input.size()) {
    write_file(folder / "r.srdf", input.substr(cut + separator.size()));
    robot.srdf = (folder / "r.srdf").string();
  }
  if (limits) {
    write_file(folder / "joint_limits.yaml", *limits);
    robot.joint_limits = (folder / "joint_limits.yaml").string();
  }
  robot.packages["meshes"] = (folder / "meshes").string();
  ArmDescription arm;
  arm.name = "a";
  arm.group = input.substr(0, line);
  robot.arms.push_back(arm);
  CellDescription cell;
  cell.name = "fuzz";
  cell.robots.push_back(robot);
  return cell;
}

// Checks what build_cell() promises: ordered limits, home within the limits, finite poses.
void demand_sound(const Cell& cell) {
  demand(cell.arms.size() == 1 && !cell.arms[0].joints.empty());
  const Configuration home = cell.home();
  demand(home.allFinite() && home.size() == static_cast<Eigen::Index>(cell.joints.size()));
  for (std::size_t j = 0; j < cell.joints.size(); ++j) {
    const Joint& joint = cell.joints[j];
    demand(joint.lower <= joint.upper && joint.velocity_max > 0.0);
    const double q = home[static_cast<Eigen::Index>(j)];
    demand(q >= joint.lower && q <= joint.upper);
  }
  for (std::size_t l = 0; l < cell.links.size(); ++l) {
    if (cell.links[l].parent) demand(cell.links[l].parent->index() < l);
  }
  LinkPoses poses;
  forward_kinematics(cell, home, poses);
  for (const Eigen::Isometry3d& X_WL : poses) demand(X_WL.matrix().allFinite());
}

}  // namespace
}  // namespace armloom::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armloom;
  static const fuzz::fs::path folder = fuzz::scratch();
  const auto cell = build_cell(fuzz::description_of(fuzz::text_of(data, size), folder));
  if (cell) {
    fuzz::demand_sound(**cell);
  } else {
    fuzz::demand_readable(cell.error());
  }
  return 0;
}
