#include "core/model/cell_doubts.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/model/mesh.h"

namespace armloom {
namespace {

constexpr double kHuge_m = 10.0;  // of a link's mesh

void warn_of_brakes(const CellDescription& description, const Cell& cell, Findings& findings) {
  for (std::size_t r = 0; r < description.robots.size(); ++r) {
    const RobotDescription& robot = description.robots[r];
    for (std::size_t a = 0; a < robot.arms.size(); ++a) {
      for (const auto& [name, given] : robot.arms[a].limits) {
        const auto joint = cell.find_joint(robot.prefix + name);
        if (!joint || !given.brake) continue;
        const double acceleration = cell.joint(*joint).acceleration_max;
        if (*given.brake >= acceleration) continue;
        const bool linear = cell.joint(*joint).kind == JointKind::prismatic;
        const std::string unit = linear ? "m_s2" : "rad_s2";
        const std::string pointer = "/robots/" + std::to_string(r) + "/arms/" + std::to_string(a) +
                                    "/limits/" + pointer_token(name) + "/brake_" + unit;
        findings.warn({ProblemKind::invalid, "weak-brake", pointer,
                       "joint " + robot.prefix + name + ": brake_" + unit + " is " +
                           text_of(*given.brake) + ", less than its acceleration_" + unit + " of " +
                           text_of(acceleration) +
                           ": a stop takes longer than the motion took to begin",
                       *given.brake});
      }
    }
  }
}

void warn_of_lags(const CellDescription& description, Findings& findings) {
  const double delay_s = to_seconds(description.checking.delay);
  for (std::size_t r = 0; r < description.robots.size(); ++r) {
    const RobotDescription& robot = description.robots[r];
    const double lag_s = to_seconds(robot.controller.lag);
    if (lag_s <= delay_s) continue;
    findings.warn({ProblemKind::invalid, "lag-above-delay",
                   "/robots/" + std::to_string(r) + "/controller/lag_s",
                   "robot " + robot.name + ": lag_s is " + text_of(lag_s) +
                       ", more than checking delay_s of " + text_of(delay_s) +
                       ": its arms follow later than motions are certified for, so the monitor "
                       "slows or stops them and others; delay_s has to be at least lag_s",
                   lag_s});
  }
}

void warn_of_noise(const CellDescription& description, Findings& findings) {
  const double error_rad = description.checking.tracking_error_rad;
  for (std::size_t r = 0; r < description.robots.size(); ++r) {
    const RobotDescription& robot = description.robots[r];
    const double noise_rad = robot.controller.noise_rad;
    if (noise_rad <= error_rad) continue;
    findings.warn({ProblemKind::invalid, "noise-above-error",
                   "/robots/" + std::to_string(r) + "/controller/noise_rad",
                   "robot " + robot.name + ": noise_rad is " + text_of(noise_rad) +
                       ", more than checking tracking_error_rad of " + text_of(error_rad) +
                       ": its arms are measured farther from their paths than motions are "
                       "certified for; tracking_error_rad has to cover the noise",
                   noise_rad});
  }
}

std::size_t open_edges(const std::vector<Triangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> borders;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++borders[std::minmax(t[i], t[(i + 1) % 3])];
  }
  return static_cast<std::size_t>(
      std::ranges::count_if(borders, [](const auto& edge) { return edge.second % 2 != 0; }));
}

class MeshDoubts {
 public:
  explicit MeshDoubts(Findings& findings) : findings_(findings) {}

  // Each file once: robots of one kind share their meshes.
  void look_at(const Shape& shape, const std::string& place, const std::string& whose,
               bool of_link) {
    const auto* mesh = std::get_if<Mesh>(&shape);
    if (mesh == nullptr || mesh->data == nullptr) return;
    if (!told_.insert(mesh->path).second) return;
    const bool flat = is_flat(*mesh->data);
    if (!flat && mesh->data->surface == nullptr) note_open(*mesh);
    if (flat)
      warn("flat-mesh", place, whose + ": mesh " + mesh->path + " is flat: it has no inside",
           mesh->path);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : mesh->data->vertices) box.extend(vertex);
    const double size_m = box.sizes().maxCoeff();
    if (of_link && size_m > kHuge_m) {
      warn("huge-mesh", place,
           whose + ": mesh " + mesh->path + " is " + text_of(size_m) +
               " m long, hardly meant (millimetres? then the URDF's mesh needs "
               "scale=\"0.001 0.001 0.001\"); it fills the cell",
           mesh->path);
    }
  }

  // All in one: meshes for collision are often of such a kind.
  void tell_open() {
    if (open_ == 0) return;
    warn("open-mesh", "",
         std::to_string(open_) + (open_ == 1 ? " mesh does" : " meshes do") +
             " not close, so convex pieces around the triangles stand for what is inside (are the "
             "files whole?): " +
             open_files_ + (open_ > kListed ? ", ..." : ""),
         open_files_);
  }

 private:
  static constexpr std::size_t kListed = 8;

  void note_open(const Mesh& mesh) {
    if (++open_ > kListed) return;
    open_files_ += (open_files_.empty() ? "" : ", ") +
                   std::filesystem::path(mesh.path).filename().string() + " (" +
                   std::to_string(open_edges(mesh.data->triangles)) + " open edges)";
  }

  void warn(const char* slug, const std::string& place, const std::string& sentence,
            const std::string& value) {
    findings_.warn({ProblemKind::invalid, slug, place, sentence, value});
  }

  Findings& findings_;
  std::set<std::string> told_;
  std::size_t open_ = 0;
  std::string open_files_;
};

}  // namespace

void warn_of_doubts(const CellDescription& description, const Cell& cell, Findings& findings) {
  warn_of_brakes(description, cell, findings);
  warn_of_lags(description, findings);
  warn_of_noise(description, findings);
  MeshDoubts meshes(findings);
  for (const Link& link : cell.links) {
    for (const PlacedShape& placed : link.shapes)
      meshes.look_at(placed.shape, "", "link " + link.name, true);
  }
  for (std::size_t o = 0; o < cell.objects.size(); ++o) {
    meshes.look_at(cell.objects[o].shape, "/objects/" + std::to_string(o) + "/mesh",
                   "object " + cell.objects[o].name, false);
  }
  meshes.tell_open();
}

}  // namespace armloom
