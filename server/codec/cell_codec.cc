#include "server/codec/cell_codec.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/codec/json_node.h"
#include "server/codec/json_text.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

constexpr double kLengthMax_m = 1000.0;
constexpr double kAngleMax_rad = 100.0;
constexpr double kTimeMax_s = 1e6;

std::string resolved(const std::string& path, const fs::path& folder) {
  return (fs::path(path).is_absolute() ? fs::path(path) : folder / path)
      .lexically_normal()
      .string();
}

void read_path(const JsonNode& node, const fs::path& folder, std::string& out) {
  std::string path;
  if (!node.read(path)) return;
  if (path.empty()) return node.invalid("empty-path", "a path is expected, found nothing");
  out = resolved(path, folder);
}

void read_name(const JsonNode& node, std::string& out) {
  if (node.read(out) && out.empty())
    node.invalid("empty-name", "a name is expected, found nothing");
}

void read_seconds(const JsonNode& node, Duration& out) {
  double seconds = 0.0;
  if (node.read_within(seconds, 0.0, kTimeMax_s)) out = from_seconds(seconds);
}

void read_bounded(const JsonNode& node, double highest, Eigen::Vector3d& out) {
  if (!node.read_numbers(out.data(), 3) || (out.array().abs() <= highest).all()) return;
  node.invalid("out-of-range", "each number is at most " + std::to_string(std::lround(highest)) +
                                   " in size, found " + node.raw().dump());
}

// Position in metres and fixed-axis roll, pitch, yaw in rad, as URDF has them.
void read_pose(const JsonNode& node, Eigen::Isometry3d& X) {
  Eigen::Vector3d xyz = Eigen::Vector3d::Zero();
  Eigen::Vector3d rpy = Eigen::Vector3d::Zero();
  node.optional("xyz", [&](const JsonNode& n) { read_bounded(n, kLengthMax_m, xyz); });
  node.optional("rpy", [&](const JsonNode& n) { read_bounded(n, kAngleMax_rad, rpy); });
  X = Eigen::Translation3d(xyz) * Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
      Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
      Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX());
}

void read_limit(const JsonNode& node, const char* angular, const char* linear,
                std::optional<double>& out) {
  const auto take = [&](const JsonNode& n) {
    double number = 0.0;
    if (n.read_positive(number)) out = number;
  };
  node.optional(angular, take);
  node.optional(linear, take);
}

void read_arm(const JsonNode& node, ArmDescription& arm) {
  if (!node.object({"name", "group", "home", "limits"})) return;
  node.required("name", [&](const JsonNode& n) { read_name(n, arm.name); });
  node.required("group", [&](const JsonNode& n) { read_name(n, arm.group); });
  node.optional("home", [&](const JsonNode& n) { n.read(arm.home); });
  node.optional("limits", [&](const JsonNode& limits) {
    limits.members([&](const std::string& joint, const JsonNode& n) {
      if (!n.object({"acceleration_rad_s2", "acceleration_m_s2", "jerk_rad_s3", "jerk_m_s3",
                     "brake_rad_s2", "brake_m_s2"})) {
        return;
      }
      JointLimitsDescription& limit = arm.limits[joint];
      read_limit(n, "acceleration_rad_s2", "acceleration_m_s2", limit.acceleration);
      read_limit(n, "jerk_rad_s3", "jerk_m_s3", limit.jerk);
      read_limit(n, "brake_rad_s2", "brake_m_s2", limit.brake);
    });
  });
}

void read_controller(const JsonNode& node, ControllerDescription& controller) {
  if (!node.object({"type", "lag_s", "noise_rad"})) return;
  node.optional("type", [&](const JsonNode& n) {
    if (n.read(controller.type) && controller.type != "sim") {
      n.invalid("unknown-controller", "the only controller type is \"sim\"");
    }
  });
  node.optional("lag_s", [&](const JsonNode& n) { read_seconds(n, controller.lag); });
  node.optional("noise_rad",
                [&](const JsonNode& n) { n.read_within(controller.noise_rad, 0.0, 1.0); });
}

void read_robot(const JsonNode& node, const fs::path& folder, RobotDescription& robot) {
  if (!node.object({"name", "urdf", "srdf", "prefix", "base", "packages", "arms", "controller"})) {
    return;
  }
  node.required("name", [&](const JsonNode& n) { read_name(n, robot.name); });
  node.required("urdf", [&](const JsonNode& n) { read_path(n, folder, robot.urdf); });
  node.required("srdf", [&](const JsonNode& n) { read_path(n, folder, robot.srdf); });
  node.optional("prefix", [&](const JsonNode& n) { n.read(robot.prefix); });
  node.optional("base", [&](const JsonNode& n) {
    if (n.object({"xyz", "rpy"})) read_pose(n, robot.X_WB);
  });
  node.optional("packages", [&](const JsonNode& packages) {
    packages.members([&](const std::string& name, const JsonNode& n) {
      read_path(n, folder, robot.packages[name]);
    });
  });
  node.required("arms", [&](const JsonNode& arms) {
    arms.each([&](const JsonNode& n) { read_arm(n, robot.arms.emplace_back()); });
    if (arms.raw().is_array() && arms.raw().empty()) {
      arms.invalid("no-arm", "a robot has at least one arm");
    }
  });
  node.optional("controller", [&](const JsonNode& n) { read_controller(n, robot.controller); });
}

// Lengths of a primitive: greater than zero, in metres.
bool read_lengths(const JsonNode& node, double* out, std::size_t size) {
  if (!node.read_numbers(out, size)) return false;
  for (std::size_t i = 0; i < size; ++i) {
    if (out[i] > 0.0 && out[i] <= kLengthMax_m) continue;
    node.invalid("out-of-range", "lengths are greater than zero and at most 1000 m");
    return false;
  }
  return true;
}

void read_shape(const JsonNode& node, const fs::path& folder, Shape& shape) {
  int shapes = 0;
  node.optional("box", [&](const JsonNode& n) {
    ++shapes;
    Box box{};
    if (read_lengths(n, box.size_m.data(), 3)) shape = box;
  });
  node.optional("cylinder", [&](const JsonNode& n) {
    ++shapes;
    double lengths[2] = {};
    if (read_lengths(n, lengths, 2)) shape = Cylinder{lengths[0], lengths[1]};
  });
  node.optional("sphere", [&](const JsonNode& n) {
    ++shapes;
    double radius[1] = {};
    if (read_lengths(n, radius, 1)) shape = Sphere{radius[0]};
  });
  node.optional("mesh", [&](const JsonNode& n) {
    ++shapes;
    Mesh mesh{};
    read_path(n, folder, mesh.path);
    node.optional("scale", [&](const JsonNode& s) { s.read_numbers(mesh.scale.data(), 3); });
    shape = mesh;
  });
  if (node.raw().contains("scale") && !node.raw().contains("mesh")) {
    node.invalid("scale-without-mesh", "only a mesh has a scale");
  }
  if (shapes != 1) {
    node.invalid("no-shape", "exactly one of box, cylinder, sphere, mesh is expected, found " +
                                 std::to_string(shapes));
  }
}

void read_object(const JsonNode& node, const fs::path& folder, ObjectDescription& object) {
  if (!node.object({"name", "box", "cylinder", "sphere", "mesh", "scale", "xyz", "rpy"})) return;
  node.required("name", [&](const JsonNode& n) { read_name(n, object.name); });
  read_shape(node, folder, object.shape);
  read_pose(node, object.X_WO);
}

void read_allowed(const JsonNode& node, CellDescription& cell) {
  std::vector<std::string> names;
  if (!node.read(names)) return;
  if (names.size() != 2) {
    return node.invalid("wrong-size",
                        "expected a pair of names, found " + std::to_string(names.size()));
  }
  cell.allowed_collisions.emplace_back(names[0], names[1]);
}

void read_checking(const JsonNode& node, CheckingSettings& checking) {
  if (!node.object({"time_step_s", "tracking_error_rad", "delay_s", "limit_tolerance"})) return;
  node.optional("time_step_s", [&](const JsonNode& n) {
    double seconds = 0.0;
    if (n.read_within(seconds, 1e-4, 10.0)) checking.time_step = from_seconds(seconds);
  });
  node.optional("tracking_error_rad",
                [&](const JsonNode& n) { n.read_within(checking.tracking_error_rad, 0.0, 1.0); });
  node.optional("delay_s", [&](const JsonNode& n) { read_seconds(n, checking.delay); });
  node.optional("limit_tolerance",
                [&](const JsonNode& n) { n.read_within(checking.limit_tolerance, 0.0, 1.0); });
}

void read_scheduling(const JsonNode& node, SchedulingSettings& scheduling) {
  if (!node.object({"policy", "backlog_timeout_s", "aging_s", "on_idle_blocker"})) return;
  node.optional("policy", [&](const JsonNode& n) { read_name(n, scheduling.policy); });
  node.optional("backlog_timeout_s",
                [&](const JsonNode& n) { read_seconds(n, scheduling.backlog_timeout); });
  node.optional("aging_s", [&](const JsonNode& n) { read_seconds(n, scheduling.aging); });
  node.optional("on_idle_blocker", [&](const JsonNode& n) {
    if (n.read(scheduling.on_idle_blocker) && scheduling.on_idle_blocker != "report" &&
        scheduling.on_idle_blocker != "park") {
      n.invalid("unknown-choice",
                "it is \"" + scheduling.on_idle_blocker + "\", expected \"report\" or \"park\"");
    }
  });
}

void read_monitor(const JsonNode& node, MonitorSettings& monitor) {
  if (!node.object({"rate_hz", "reaction_s", "stop_clearance_m"})) return;
  node.optional("rate_hz", [&](const JsonNode& n) { n.read_within(monitor.rate_hz, 1.0, 1000.0); });
  node.optional("reaction_s", [&](const JsonNode& n) { read_seconds(n, monitor.reaction); });
  node.optional("stop_clearance_m",
                [&](const JsonNode& n) { n.read_within(monitor.stop_clearance_m, 0.0, 1.0); });
}

void read_execution(const JsonNode& node, ExecutionSettings& execution) {
  if (!node.object({"start_tolerance_rad", "duration_scaling", "duration_margin_s"})) return;
  node.optional("start_tolerance_rad",
                [&](const JsonNode& n) { n.read_within(execution.start_tolerance_rad, 0.0, 1.0); });
  node.optional("duration_scaling",
                [&](const JsonNode& n) { n.read_within(execution.duration_scaling, 1.0, 100.0); });
  node.optional("duration_margin_s",
                [&](const JsonNode& n) { read_seconds(n, execution.duration_margin); });
}

void read_cell(const JsonNode& node, const fs::path& folder, CellDescription& cell) {
  if (!node.object({"name", "robots", "objects", "allowed_collisions", "clearance_m",
                    "self_clearance_m", "checking", "scheduling", "monitor", "execution"})) {
    return;
  }
  node.required("name", [&](const JsonNode& n) { read_name(n, cell.name); });
  node.required("robots", [&](const JsonNode& robots) {
    robots.each([&](const JsonNode& n) { read_robot(n, folder, cell.robots.emplace_back()); });
    if (robots.raw().is_array() && robots.raw().empty()) {
      robots.invalid("no-robot", "a cell has at least one robot");
    }
  });
  node.optional("objects", [&](const JsonNode& objects) {
    objects.each([&](const JsonNode& n) { read_object(n, folder, cell.objects.emplace_back()); });
  });
  node.optional("allowed_collisions", [&](const JsonNode& pairs) {
    pairs.each([&](const JsonNode& n) { read_allowed(n, cell); });
  });
  node.optional("clearance_m",
                [&](const JsonNode& n) { n.read_within(cell.clearance_m, 0.0, 1.0); });
  node.optional("self_clearance_m",
                [&](const JsonNode& n) { n.read_within(cell.self_clearance_m, 0.0, 1.0); });
  node.optional("checking", [&](const JsonNode& n) { read_checking(n, cell.checking); });
  node.optional("scheduling", [&](const JsonNode& n) { read_scheduling(n, cell.scheduling); });
  node.optional("monitor", [&](const JsonNode& n) { read_monitor(n, cell.monitor); });
  node.optional("execution", [&](const JsonNode& n) { read_execution(n, cell.execution); });
}

void relocate(nlohmann::json& owner, const char* key, const fs::path& from, const fs::path& to) {
  const auto it = owner.find(key);
  if (it == owner.end() || !it->is_string()) return;
  const fs::path target = fs::weakly_canonical(resolved(it->get<std::string>(), from));
  *it = target.lexically_proximate(fs::weakly_canonical(to)).generic_string();
}

}  // namespace

Result<CollisionObject> read_object_text(std::string_view text,
                                         const std::optional<std::string>& name) {
  auto body = parse_json(text, JsonComments::refused);
  if (!body) return failure(body.error());
  Problems faults;
  if (name && body->is_object() && !body->contains("name")) (*body)["name"] = *name;
  const JsonNode node(*body, "", faults);
  ObjectDescription object;
  if (node.is_object() && node.has("mesh")) {
    node.optional("mesh", [](const JsonNode& n) {
      n.invalid("unsupported",
                "meshes are part of the cell file; over HTTP an object is a box, a "
                "cylinder or a sphere");
    });
  } else {
    read_object(node, "", object);
  }
  node.optional("name", [&](const JsonNode& n) {
    const bool plain = std::ranges::none_of(object.name,
                                            [](char c) {
                                              return static_cast<unsigned char>(c) < 0x20 ||
                                                     c == 0x7f || c == '/' || c == '\\';
                                            }) &&
                       object.name != "." && object.name != "..";
    if (object.name.size() > kObjectNameMax || !plain) {
      n.invalid(
          "bad-name",
          "a name is at most 128 bytes without slashes and control characters, and not . or ..");
    } else if (name && n.raw().is_string() && n.raw() != *name) {
      n.invalid("name-differs", "the name differs from \"" + *name + "\" in the address");
    }
  });
  if (!faults.empty()) return failure(std::move(faults));
  return CollisionObject{std::move(object.name), object.shape, object.X_WO};
}

Result<CellDescription> read_cell_text(std::string_view text, const fs::path& folder) {
  const auto file = parse_json(text, JsonComments::allowed);
  if (!file) return failure(file.error());
  Problems faults;
  CellDescription cell;
  read_cell(JsonNode(*file, "", faults), folder, cell);
  if (!faults.empty()) return failure(std::move(faults));
  return cell;
}

std::string relocate_cell_text(std::string_view text, const fs::path& from, const fs::path& to) {
  auto file = parse_json(text, JsonComments::allowed);
  if (!file) return std::string(text);
  for (auto& robot : (*file)["robots"]) {
    relocate(robot, "urdf", from, to);
    relocate(robot, "srdf", from, to);
    if (!robot.contains("packages")) continue;
    std::vector<std::string> names;
    for (const auto& entry : robot["packages"].items()) names.push_back(entry.key());
    for (const std::string& name : names) relocate(robot["packages"], name.c_str(), from, to);
  }
  if (file->contains("objects")) {
    for (auto& object : (*file)["objects"]) relocate(object, "mesh", from, to);
  }
  return file->dump(2) + "\n";
}

}  // namespace armloom
