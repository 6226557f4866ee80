#include "core/model/cell/cell_checks.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "core/base/number_range.h"
#include "core/base/plain_name.h"
#include "core/model/endpoint.h"

namespace armloom {
namespace {

// Reports a setting that is not finite or for which `holds` is false; `rule` completes the message.
// The conditions below are false for NaN.
void require(bool holds, double value, const std::string& pointer, const std::string& rule,
             Diagnostics& diagnostics) {
  if (holds && std::isfinite(value)) return;
  const std::string key = pointer.substr(pointer.rfind('/') + 1);
  diagnostics.in_cell("setting-out-of-range", pointer,
                      key + " is " + text_of(value) + ", it must be " + rule, value);
}

void check_endpoint(const ControllerDescription& controller, const std::string& pointer,
                    Diagnostics& diagnostics) {
  if (controller.type != "remote") {
    if (controller.endpoint.empty()) return;
    diagnostics.in_cell("endpoint-not-used", pointer + "/endpoint",
                        "a controller of type " + controller.type +
                            " has no endpoint: remove it, or set the type to remote",
                        controller.endpoint);
  } else if (controller.endpoint.empty()) {
    diagnostics.in_cell("missing", pointer,
                        "a remote controller needs its endpoint: unix:PATH or tcp:HOST:PORT");
  } else if (const auto endpoint = parse_endpoint(controller.endpoint); !endpoint) {
    diagnostics.in_cell("bad-endpoint", pointer + "/endpoint", endpoint.error().front().detail,
                        controller.endpoint);
  } else if (endpoint->port == "0") {
    diagnostics.in_cell("bad-endpoint", pointer + "/endpoint",
                        "the server cannot connect to port 0: name the controller's port",
                        controller.endpoint);
  }
}

// Reports robots that share an endpoint: a process is one robot, so the others would never connect.
void check_endpoints(const CellDescription& description, Diagnostics& diagnostics) {
  std::map<std::string, std::size_t> first;  // robot, by endpoint
  for (std::size_t r = 0; r < description.robots.size(); ++r) {
    const ControllerDescription& controller = description.robots[r].controller;
    const std::string pointer = "/robots/" + std::to_string(r) + "/controller";
    check_endpoint(controller, pointer, diagnostics);
    auto endpoint = parse_endpoint(controller.endpoint);
    if (controller.type != "remote" || !endpoint) continue;
    endpoint->path = std::filesystem::path(endpoint->path).lexically_normal().string();
    const auto [it, is_new] = first.emplace(endpoint->text(), r);
    if (is_new) continue;
    diagnostics.in_cell("duplicate-endpoint", pointer + "/endpoint",
                        "the endpoint " + controller.endpoint + " is also that of robot " +
                            description.robots[it->second].name + " (/robots/" +
                            std::to_string(it->second) +
                            "/controller/endpoint): give each robot an endpoint of its own",
                        controller.endpoint);
  }
}

class ShapeCheck {
 public:
  ShapeCheck(const ObjectDescription& object, std::string pointer, Diagnostics& diagnostics)
      : object_(object), pointer_(std::move(pointer)), diagnostics_(diagnostics) {}

  void operator()(const Box& box) const {
    for (int i = 0; i < 3; ++i) positive(box.size_m[i], "/box/" + std::to_string(i), "box side");
  }
  void operator()(const Cylinder& cylinder) const {
    positive(cylinder.radius_m, "/cylinder/0", "cylinder radius");
    positive(cylinder.length_m, "/cylinder/1", "cylinder length");
  }
  void operator()(const Sphere& sphere) const {
    positive(sphere.radius_m, "/sphere/0", "sphere radius");
  }
  void operator()(const Mesh& mesh) const {
    std::error_code error;
    if (!std::filesystem::is_regular_file(mesh.path, error)) {
      diagnostics_.in_cell(
          "file-missing", pointer_ + "/mesh",
          "object " + object_.name + ": mesh " + mesh.path + " is not a file that exists",
          mesh.path);
    }
    if (!mesh.scale.allFinite() || (mesh.scale.array() == 0.0).any()) {
      diagnostics_.in_cell("not-positive", pointer_ + "/mesh",
                           "object " + object_.name + ": mesh scale must be finite and not 0",
                           mesh.path);
    }
  }

 private:
  void positive(double length, const std::string& at, const std::string& what) const {
    if (std::isfinite(length) && length > 0.0) return;
    diagnostics_.in_cell("not-positive", pointer_ + at,
                         "object " + object_.name + ": " + what + " is " + text_of(length) +
                             " m, it must be greater than 0",
                         length);
  }

  const ObjectDescription& object_;
  std::string pointer_;
  Diagnostics& diagnostics_;
};

}  // namespace

void check_name(const std::string& name, const std::string& kind, const std::string& pointer,
                std::set<std::string>& known, Diagnostics& diagnostics) {
  if (name.empty()) {
    diagnostics.in_cell("missing", pointer, "the name of " + kind + " is empty", name);
  } else if (!known.insert(name).second) {
    diagnostics.in_cell("duplicate-name", pointer,
                        "the name " + name + " of " + kind + " is already taken", name);
  } else if (!is_plain_name(name)) {
    diagnostics.in_cell("bad-name", pointer,
                        "the name of " + kind + " is used in API paths: " + kPlainNameRule, name);
  }
}

void check_names(const CellDescription& description, Diagnostics& diagnostics) {
  std::set<std::string> robots;
  std::set<std::string> arms;
  std::set<std::string> objects;
  for (std::size_t r = 0; r < description.robots.size(); ++r) {
    const RobotDescription& robot = description.robots[r];
    const std::string pointer = "/robots/" + std::to_string(r);
    check_name(robot.name, "a robot", pointer + "/name", robots, diagnostics);
    for (std::size_t a = 0; a < robot.arms.size(); ++a) {
      check_name(robot.arms[a].name, "an arm", pointer + "/arms/" + std::to_string(a) + "/name",
                 arms, diagnostics);
    }
  }
  for (std::size_t o = 0; o < description.objects.size(); ++o) {
    check_name(description.objects[o].name, "an object", "/objects/" + std::to_string(o) + "/name",
               objects, diagnostics);
  }
}

void check_objects(const CellDescription& description, Diagnostics& diagnostics) {
  for (std::size_t o = 0; o < description.objects.size(); ++o) {
    const ObjectDescription& object = description.objects[o];
    const std::string pointer = "/objects/" + std::to_string(o);
    std::visit(ShapeCheck(object, pointer, diagnostics), object.shape);
    check_pose(object.X_WO, pointer, "object " + object.name, diagnostics);
  }
}

void check_pose(const Eigen::Isometry3d& X, const std::string& pointer, const std::string& whose,
                Diagnostics& diagnostics) {
  constexpr double kRounding = 1e-9;
  if (!X.matrix().allFinite()) {
    diagnostics.in_cell("pose-not-finite", pointer,
                        whose + ": the pose holds a number that is not finite");
  } else if (!X.linear().isUnitary(kRounding) || X.linear().determinant() < 0.0) {
    diagnostics.in_cell("pose-not-rigid", pointer,
                        whose + ": the pose is not a rotation and a translation");
  }
}

void check_settings(const CellDescription& d, Diagnostics& diagnostics) {
  const auto within = [&](const NumberRange& range, double value, const std::string& pointer) {
    require(range.holds(value), value, pointer, in_words(range), diagnostics);
  };
  const auto time_within = [&](const NumberRange& range_s, Duration time,
                               const std::string& pointer) {
    within(range_s, to_seconds(time), pointer);
  };
  within(d.clearance_range, d.clearance_m, "/clearance_m");
  within(d.clearance_range, d.self_clearance_m, "/self_clearance_m");
  within(d.clearance_range, d.mount_clearance_m.value_or(0.0), "/mount_clearance_m");

  const CheckingSettings& checking = d.checking;
  time_within(checking.time_step_range, checking.time_step, "/checking/time_step_s");
  within(checking.tracking_error_range, checking.tracking_error_rad,
         "/checking/tracking_error_rad");
  time_within(checking.delay_range, checking.delay, "/checking/delay_s");
  within(checking.limit_tolerance_range, checking.limit_tolerance, "/checking/limit_tolerance");

  const SchedulingSettings& scheduling = d.scheduling;
  time_within(scheduling.backlog_timeout_range, scheduling.backlog_timeout,
              "/scheduling/backlog_timeout_s");
  time_within(scheduling.aging_range, scheduling.aging, "/scheduling/aging_s");
  within(scheduling.horizon_steps_range, scheduling.horizon_steps, "/scheduling/horizon_steps");

  const MonitorSettings& monitor = d.monitor;
  within(monitor.rate_range, monitor.rate_hz, "/monitor/rate_hz");
  time_within(monitor.reaction_range, monitor.reaction, "/monitor/reaction_s");
  within(monitor.stop_clearance_range, monitor.stop_clearance_m, "/monitor/stop_clearance_m");
  require(!(monitor.stop_clearance_m > d.clearance_m && d.clearance_m >= 0.0),
          monitor.stop_clearance_m, "/monitor/stop_clearance_m",
          "at most clearance_m (" + text_of(d.clearance_m) + " m)", diagnostics);

  const ExecutionSettings& execution = d.execution;
  within(execution.start_tolerance_range, execution.start_tolerance_rad,
         "/execution/start_tolerance_rad");
  within(execution.duration_scaling_range, execution.duration_scaling,
         "/execution/duration_scaling");
  time_within(execution.duration_margin_range, execution.duration_margin,
              "/execution/duration_margin_s");
  within(execution.velocity_scaling_range, execution.velocity_scaling_factor,
         "/execution/velocity_scaling_factor");

  for (std::size_t r = 0; r < d.robots.size(); ++r) {
    const ControllerDescription& controller = d.robots[r].controller;
    const std::string pointer = "/robots/" + std::to_string(r) + "/controller";
    time_within(controller.lag_range, controller.lag, pointer + "/lag_s");
    within(controller.noise_range, controller.noise_rad, pointer + "/noise_rad");
    time_within(controller.reaction_range, controller.reaction, pointer + "/reaction_s");
    time_within(controller.feedback_period_range, controller.feedback_period,
                pointer + "/feedback_period_s");
    time_within(controller.feedback_timeout_range, controller.feedback_timeout,
                pointer + "/feedback_timeout_s");
    require(controller.feedback_timeout >= 2 * controller.feedback_period,
            to_seconds(controller.feedback_timeout), pointer + "/feedback_timeout_s",
            "at least twice feedback_period_s (" + text_of(to_seconds(controller.feedback_period)) +
                " s), so that one late report does not make the arm count as lost",
            diagnostics);
    if (controller.tracking_error_rad) {
      within(CheckingSettings::tracking_error_range, *controller.tracking_error_rad,
             pointer + "/tracking_error_rad");
    }
  }
  check_endpoints(d, diagnostics);
}

}  // namespace armloom
