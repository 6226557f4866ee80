#include "core/model/cell/cell_warnings.h"

#include <cmath>
#include <set>

#include "core/geometry/mesh/mesh.h"

namespace armloom {
namespace {

constexpr double kHuge_m = 10.0;  // a link's mesh of this size is probably a unit error
constexpr double kHugeObject_m = 100.0;
constexpr double kTiny_m = 0.002;

void warn_of_brakes(const CellDescription& description, const Cell& cell,
                    Diagnostics& diagnostics) {
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
        diagnostics.warn(
            {ProblemKind::invalid, "weak-brake", pointer,
             "joint " + robot.prefix + name + ": brake_" + unit + " is " + text_of(*given.brake) +
                 ", less than its acceleration_" + unit + " of " + text_of(acceleration) +
                 ": the joint takes longer to stop than to reach its speed; check the value",
             *given.brake});
      }
    }
  }
}

void warn_of_lags(const CellDescription& description, Diagnostics& diagnostics) {
  const double delay_s = to_seconds(description.checking.delay);
  for (std::size_t r = 0; r < description.robots.size(); ++r) {
    const RobotDescription& robot = description.robots[r];
    const double lag_s = to_seconds(robot.controller.lag);
    if (lag_s <= delay_s) continue;
    diagnostics.warn(
        {ProblemKind::invalid, "lag-above-delay",
         "/robots/" + std::to_string(r) + "/controller/lag_s",
         "robot " + robot.name + ": lag_s is " + text_of(lag_s) +
             ", more than checking delay_s of " + text_of(delay_s) +
             ": its arms follow late, and arms that pass after them wait that much longer, because "
             "passing depends on measured progress; reduce lag_s, or raise delay_s to at least "
             "lag_s if the lag is real",
         lag_s});
  }
}

// One value in 500 million of normally distributed noise is beyond six standard deviations.
constexpr double kSigmas = 6.0;

void warn_of_noise(const CellDescription& description, Diagnostics& diagnostics) {
  for (std::size_t r = 0; r < description.robots.size(); ++r) {
    const RobotDescription& robot = description.robots[r];
    const double noise_rad = robot.controller.noise_rad;
    const double error_rad =
        robot.controller.tracking_error_rad.value_or(description.checking.tracking_error_rad);
    if (kSigmas * noise_rad <= error_rad) continue;
    diagnostics.warn({ProblemKind::invalid, "noise-above-error",
                      "/robots/" + std::to_string(r) + "/controller/noise_rad",
                      "robot " + robot.name + ": noise_rad is " + text_of(noise_rad) +
                          ", more than a sixth of its tracking_error_rad of " + text_of(error_rad) +
                          ": measured positions deviate farther from the paths than motions "
                          "are certified for; raise the controller's tracking_error_rad to " +
                          text_of(kSigmas * noise_rad) + " to cover the noise",
                      noise_rad});
  }
}

class MeshWarnings {
 public:
  explicit MeshWarnings(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // Checks each mesh file only once, because robots of one kind share their meshes.
  void look_at(const Shape& shape, const std::string& place, const std::string& whose,
               bool of_link) {
    const auto* mesh = std::get_if<Mesh>(&shape);
    if (mesh == nullptr || mesh->data == nullptr) return;
    if (!told_.insert(mesh->path).second) return;
    const std::string named = whose + ": mesh " + mesh->path;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : mesh->data->vertices) box.extend(vertex);
    const double size_m = box.sizes().maxCoeff();
    if (size_m < kTiny_m) {
      warn("tiny-mesh", place,
           named + " is " + text_of(std::round(1e6 * size_m) / 1e6) +
               " m long, probably a unit error (scale applied to a file already in meters?); "
               "almost nothing is checked for this mesh",
           mesh->path);
    } else if (is_flat(*mesh->data)) {
      warn("flat-mesh", place, named + " is flat: it encloses no volume; check the file",
           mesh->path);
    } else if (const std::size_t open = mesh->data->open_edges; open > 0) {
      warn("open-mesh", place,
           named + " is not closed: " + std::to_string(open) +
               " edges border only one triangle (holes, or a truncated file?). Its inside is "
               "unknown, so its convex hull is checked: notches and hollows are treated as solid",
           mesh->path);
    } else if (mesh->data->both_sides) {
      warn(
          "two-sided-mesh", place,
          named +
              " has two-sided faces with other faces on their edges: its inside is unknown, so its "
              "convex pieces are checked: notches and hollows may be treated as solid",
          mesh->path);
    }
    if (size_m > (of_link ? kHuge_m : kHugeObject_m)) {
      warn("huge-mesh", place,
           named + " is " + text_of(size_m) + " m long, probably a unit error (millimeters? then " +
               (of_link ? "the URDF's mesh needs scale=\"0.001 0.001 0.001\""
                        : "the object needs \"scale\": [0.001, 0.001, 0.001]") +
               "); it fills the cell",
           mesh->path);
    }
  }

 private:
  void warn(const char* slug, const std::string& place, const std::string& sentence,
            const std::string& value) {
    diagnostics_.warn({ProblemKind::invalid, slug, place, sentence, value});
  }

  Diagnostics& diagnostics_;
  std::set<std::string> told_;
};

}  // namespace

void warn_of_cell(const CellDescription& description, const Cell& cell, Diagnostics& diagnostics) {
  warn_of_brakes(description, cell, diagnostics);
  warn_of_lags(description, diagnostics);
  warn_of_noise(description, diagnostics);
  MeshWarnings meshes(diagnostics);
  for (const Link& link : cell.links) {
    for (const PlacedShape& placed : link.shapes)
      meshes.look_at(placed.shape, "", "link " + link.name, true);
  }
  for (std::size_t o = 0; o < cell.objects.size(); ++o) {
    meshes.look_at(cell.objects[o].shape, "/objects/" + std::to_string(o) + "/mesh",
                   "object " + cell.objects[o].name, false);
  }
}

}  // namespace armloom
