#include "core/model/cell/setting_warnings.h"

#include <string>

#include "core/model/promises.h"

namespace armloom {
namespace {

// Settings beyond these are probably mistakes.
constexpr double kLargeError_rad = 0.1;
constexpr double kLargeTolerance = 0.5;
constexpr double kLargeStart_rad = 0.1;
constexpr double kLongStep_s = 0.2;
constexpr double kSeldom_hz = 10.0;
constexpr double kLongReaction_s = 0.5;
constexpr double kLongTimeout_s = 2.0;
constexpr double kStrongBrake = 10.0;  // times the acceleration
constexpr double kFar_m = 100.0;

class SettingWarnings {
 public:
  SettingWarnings(const CellDescription& description, const Cell& cell, Diagnostics& diagnostics)
      : given_(description), cell_(cell), diagnostics_(diagnostics) {}

  void tell() const {
    warn_of_clearances();
    warn_of_checking();
    warn_of_monitor();
    warn_of_places();
    for (std::size_t r = 0; r < given_.robots.size(); ++r) {
      warn_of_brakes(r);
      warn_of_promises(r);
    }
  }

 private:
  // Warns: "<key> is <value><consequence>". The key is the last part of the pointer.
  void warn(const std::string& pointer, double value, const std::string& consequence) const {
    const std::string key = pointer.substr(pointer.rfind('/') + 1);
    diagnostics_.warn({ProblemKind::invalid, "doubtful-setting", pointer,
                       key + " is " + text_of(value) + consequence, value});
  }

  void warn_of_clearances() const {
    const double clearance_m = given_.clearance_m;
    const std::string counts =
        ", more than clearance_m, so clearance_m applies: " + text_of(clearance_m) + " m";
    if (given_.self_clearance_m > clearance_m &&
        given_.self_clearance_m != CellDescription{}.self_clearance_m)
      warn("/self_clearance_m", given_.self_clearance_m, counts);
    if (given_.mount_clearance_m.value_or(0.0) > clearance_m)
      warn("/mount_clearance_m", *given_.mount_clearance_m, counts);
    if (clearance_m == 0.0)
      warn("/clearance_m", clearance_m,
           ": motions may touch, and model, mounting and measurement errors are not covered; set a "
           "clearance larger than these errors");
  }

  void warn_of_error(const std::string& pointer, double error_rad) const {
    if (error_rad == 0.0)
      warn(pointer, error_rad,
           ": motions are certified for arms that follow their paths exactly, which no arm does; "
           "set the real tracking error");
    if (error_rad > kLargeError_rad)
      warn(
          pointer, error_rad,
          " for each joint: arms are checked with that much deviation, so almost no motion will be "
          "free of conflicts");
  }

  void warn_of_promises(std::size_t r) const {
    const ControllerDescription& controller = given_.robots[r].controller;
    const std::string pointer = "/robots/" + std::to_string(r) + "/controller";
    if (controller.tracking_error_rad)
      warn_of_error(pointer + "/tracking_error_rad", *controller.tracking_error_rad);
    const double reaction_s = to_seconds(controller.reaction);
    if (reaction_s > kLongReaction_s)
      warn(pointer + "/reaction_s", reaction_s,
           ": a stopping arm moves on that long before it brakes; reduce it if the controller "
           "reacts faster");
    const double timeout_s = to_seconds(controller.feedback_timeout);
    if (timeout_s > kLongTimeout_s)
      warn(pointer + "/feedback_timeout_s", timeout_s,
           ": a lost arm is noticed that late, and other arms stay out of the " +
               text_of(to_seconds(promises_of(controller).free_run())) +
               " s of its path for which it has authority; reduce it if reports come more often");
  }

  void warn_of_checking() const {
    const CheckingSettings& checking = given_.checking;
    warn_of_error("/checking/tracking_error_rad", checking.tracking_error_rad);
    if (checking.limit_tolerance > kLargeTolerance)
      warn("/checking/limit_tolerance", checking.limit_tolerance,
           ": jobs may exceed the joints' velocity and acceleration limits by that share");
    const double step_s = to_seconds(checking.time_step);
    if (given_.scheduling.policy == "timed_discrete" && step_s > kLongStep_s)
      warn("/checking/time_step_s", step_s,
           ": timed_discrete misses collisions between two such steps; reduce it, or use a "
           "certified policy");
    if (given_.execution.start_tolerance_rad > kLargeStart_rad)
      warn("/execution/start_tolerance_rad", given_.execution.start_tolerance_rad,
           ": a job may begin with its joints that far off its path, and the motion onto the path "
           "is not checked");
  }

  void warn_of_monitor() const {
    if (given_.monitor.stop_clearance_m == 0.0 && given_.clearance_m > 0.0)
      warn("/monitor/stop_clearance_m", 0.0,
           ": the monitor stops arms only when they touch; set a part of clearance_m, so that they "
           "can brake before");
    const double reaction_s = to_seconds(given_.monitor.reaction);
    const double rate_hz = given_.monitor.rate_hz;
    if (rate_hz > 0.0 && rate_hz < kSeldom_hz)
      warn("/monitor/rate_hz", rate_hz,
           ": the monitor checks only every " + text_of(1.0 / rate_hz) +
               " s, and detects an arm that leaves its path that much later");
    if (reaction_s > kLongReaction_s)
      warn("/monitor/reaction_s", reaction_s,
           ": a stopping arm moves on that long before it brakes, so that much of its path must be "
           "free, and other arms wait for it");
    if (given_.monitor.rate_hz > 0.0 && reaction_s * given_.monitor.rate_hz < 1.0)
      warn("/monitor/reaction_s", reaction_s,
           ", less than the monitor's period (" + text_of(1.0 / given_.monitor.rate_hz) +
               " s): arms may move on longer before they brake than stops are certified for; raise "
               "reaction_s or rate_hz");
  }

  void warn_of_places() const {
    const auto far = [&](const std::string& pointer, const Eigen::Isometry3d& X,
                         const std::string& whose) {
      const double away_m = X.translation().norm();
      if (away_m <= kFar_m) return;
      diagnostics_.warn({ProblemKind::invalid, "far-away", pointer,
                         whose + " is " + text_of(away_m) +
                             " m away from the cell's origin, probably a unit error (millimeters?)",
                         away_m});
    };
    for (std::size_t r = 0; r < given_.robots.size(); ++r)
      far("/robots/" + std::to_string(r) + "/base", given_.robots[r].X_WB,
          "robot " + given_.robots[r].name);
    for (std::size_t o = 0; o < given_.objects.size(); ++o)
      far("/objects/" + std::to_string(o), given_.objects[o].X_WO,
          "object " + given_.objects[o].name);
  }

  void warn_of_brakes(std::size_t r) const {
    const RobotDescription& robot = given_.robots[r];
    for (std::size_t a = 0; a < robot.arms.size(); ++a) {
      for (const auto& [name, limits] : robot.arms[a].limits) {
        const auto joint = cell_.find_joint(robot.prefix + name);
        if (!joint || !limits.brake) continue;
        const Joint& one = cell_.joint(*joint);
        if (*limits.brake <= kStrongBrake * one.acceleration_max) continue;
        const bool slides = one.kind == JointKind::prismatic;
        warn("/robots/" + std::to_string(r) + "/arms/" + std::to_string(a) + "/limits/" +
                 pointer_token(name) + "/brake_" + (slides ? "m_s2" : "rad_s2"),
             *limits.brake,
             ", over ten times the joint's acceleration of " + text_of(one.acceleration_max) +
                 ": stops are certified for a brake that strong; if the real one is weaker, arms "
                 "stop too late");
      }
    }
  }

  const CellDescription& given_;
  const Cell& cell_;
  Diagnostics& diagnostics_;
};

}  // namespace

void warn_of_settings(const CellDescription& description, const Cell& cell,
                      Diagnostics& diagnostics) {
  SettingWarnings(description, cell, diagnostics).tell();
}

}  // namespace armloom
