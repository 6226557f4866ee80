#include "test/bench/mesh_cells.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "test/geometry/small_meshes.h"
#include "test/source_dir.h"

namespace armloom::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kNearFrames_m = 0.3;
constexpr double kLength_m = 0.3;  // of a link
constexpr int kSegments = 24;
constexpr int kLinks = 6;

// A U along x, open upwards, 0.1 m wide, with 0.02 m walls.
small::Surface channel_along_x(double low, double high) {
  constexpr double kOutline[8][2] = {{-.05, -.05}, {.05, -.05},  {.05, .05},  {.03, .05},
                                     {.03, -.03},  {-.03, -.03}, {-.03, .05}, {-.05, .05}};
  small::Surface surface;
  for (int s = 0; s <= kSegments; ++s) {
    for (const auto& [y, z] : kOutline) {
      surface.vertices.emplace_back(low + (high - low) * s / kSegments, y, z);
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
  };
  for (std::uint32_t s = 0; s < kSegments; ++s) {
    for (std::uint32_t i = 0; i < 8; ++i) {
      const std::uint32_t a = 8 * s + i;
      const std::uint32_t b = 8 * s + (i + 1) % 8;
      quad(a, a + 8, b + 8, b);
    }
  }
  constexpr std::uint32_t kEnd[3][4] = {{0, 1, 4, 5}, {1, 2, 3, 4}, {0, 5, 6, 7}};
  for (const auto& [a, b, c, d] : kEnd) {
    quad(a, b, c, d);
    const std::uint32_t end = 8 * kSegments;
    quad(end + d, end + c, end + b, end + a);
  }
  return surface;
}

std::string urdf() {
  std::string text = "<robot name=\"channels\"><link name=\"base\"/>";
  std::string parent = "base";
  for (int i = 1; i <= kLinks; ++i) {
    const std::string n = std::to_string(i);
    text += "<link name=\"link" + n +
            "\"><collision><geometry><mesh filename=\"link.stl\"/></geometry></collision></link>"
            "<joint name=\"joint" +
            n + "\" type=\"revolute\"><parent link=\"" + parent + "\"/><child link=\"link" + n +
            "\"/><origin xyz=\"" + (i == 1 ? "0 0 0.3" : "0.38 0 0") + "\"/><axis xyz=\"" +
            (i % 2 == 1 ? "0 0 1" : "0 1 0") +
            "\"/><limit lower=\"-2.5\" upper=\"2.5\" effort=\"10\" velocity=\"2\"/></joint>";
    parent = "link" + n;
  }
  return text + "</robot>";
}

std::string srdf() {
  std::string text = "<robot name=\"channels\"><group name=\"arm\">";
  for (int i = 1; i <= kLinks; ++i) text += "<joint name=\"joint" + std::to_string(i) + "\"/>";
  text += "</group>";
  for (int i = 1; i < kLinks; ++i) {
    text += "<disable_collisions link1=\"link" + std::to_string(i) + "\" link2=\"link" +
            std::to_string(i + 1) + "\" reason=\"Adjacent\"/>";
  }
  return text + "</robot>";
}

std::string robot(const std::string& name, const std::string& base) {
  return R"({"name": ")" + name + R"(", "urdf": "arm.urdf", "srdf": "arm.srdf", "prefix": ")" +
         name + R"(_", "base": )" + base + R"(, "arms": [{"name": ")" + name +
         R"(", "group": "arm", "home": [0, -1.2, 0, 0.3, 0, 0.3]}]})";
}

CellPtr cell_of(const std::string& text, const std::string& folder) {
  const auto cell = read_cell_text(text, folder).and_then([](const CellDescription& read) {
    return build_cell(read);
  });
  if (!cell) throw std::runtime_error(cell.error().front().detail);
  return *cell;
}

bool frames_near(const Cell& cell, const Configuration& q, LinkPoses& X_WL) {
  forward_kinematics(cell, q, X_WL);
  for (const LinkId a : cell.arms[0].links) {
    for (const LinkId b : cell.arms[1].links) {
      const Eigen::Vector3d apart = X_WL[a.index()].translation() - X_WL[b.index()].translation();
      if (apart.norm() < kNearFrames_m) return true;
    }
  }
  return false;
}

}  // namespace

CellPtr cell_of_file(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + " cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return cell_of(text.str(), path.parent_path().string());
}

CellPtr two_shuttles() { return cell_of_file(source_dir() + "/config/two_shuttles.json"); }

CellPtr two_channel_arms() {
  const fs::path folder =
      fs::temp_directory_path() / ("armloom_channels_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
  };
  write("link.stl", small::stl_bytes(channel_along_x(0.04, 0.04 + kLength_m)));
  write("arm.urdf", urdf());
  write("arm.srdf", srdf());
  const std::string text = R"({"name": "channels", "robots": [)" +
                           robot("left", R"({"xyz": [-0.45, 0, 0], "rpy": [0, 0, 0]})") + ", " +
                           robot("right", R"({"xyz": [0.45, 0, 0], "rpy": [0, 0, 3.14159265]})") +
                           "]}";
  const CellPtr cell = cell_of(text, folder.string());
  fs::remove_all(folder);
  if (!cell) throw std::runtime_error("the channel arms do not load");
  return cell;
}

std::vector<Configuration> random_states(const Cell& cell, std::size_t count, bool near) {
  std::mt19937_64 random(2029);
  std::vector<Configuration> states;
  Configuration q = cell.home();
  LinkPoses X_WL;
  while (states.size() < count) {
    for (const Arm& arm : cell.arms) {
      for (const JointId id : arm.joints) {
        const Joint& joint = cell.joint(id);
        const double u = static_cast<double>(random() >> 11U) * 0x1p-53;
        q[static_cast<Eigen::Index>(id.index())] = joint.lower + u * (joint.upper - joint.lower);
      }
    }
    if (!near || frames_near(cell, q, X_WL)) states.push_back(q);
  }
  return states;
}

}  // namespace armloom::bench
