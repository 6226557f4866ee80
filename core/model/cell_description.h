#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/number_range.h"
#include "core/base/time.h"
#include "core/geometry/shape.h"
#include "core/model/io_description.h"

namespace armloom {

// A cell file as plain data, not yet checked against the robots' URDFs. Default values here are the
// documented defaults of the file. Names are spelled as in the file.

// Limits of one joint as given in the cell file. A missing value is taken from joint_limits.yaml,
// then from the URDF, then from the default below.
struct JointLimitsDescription {
  std::optional<double> lower;         // rad (m): not below the URDF's
  std::optional<double> upper;         // rad (m): not above the URDF's
  std::optional<double> velocity;      // rad/s (m/s): not above the URDF's
  std::optional<double> acceleration;  // rad/s^2 (m/s^2), default kDefaultAcceleration
  std::optional<double> jerk;          // rad/s^3 (m/s^3), default kDefaultJerk
  std::optional<double> brake;         // rad/s^2 (m/s^2), default twice the acceleration
  // The given keys as spelled in the cell file (velocity_m_s). Their units must fit the joint.
  std::set<std::string> keys = {};
};
inline constexpr double kDefaultVelocity = 1.0;  // for joints in no arm's group; as in MoveIt
inline constexpr double kDefaultAcceleration = 3.75;
inline constexpr double kDefaultJerk = 7500.0;

// How much an arm may carry, and how it brakes then.
struct PayloadDescription {
  inline static constexpr NumberRange mass_range{0.0, 1e5, true};
  inline static constexpr NumberRange brake_range{0.05, 1.0};
  inline static constexpr NumberRange lever_range{0.0, 100.0, true};

  double max_kg = 1.0;
  // The share of its limits of brake and acceleration that the arm keeps with max_kg.
  double brake_at_max = 1.0;
  // The center of mass may be this far (m) from the origin of the link that carries the object. A
  // mass farther away counts as more, in proportion.
  double lever_m = 0.1;

  bool operator==(const PayloadDescription&) const = default;
};

struct ArmDescription {
  std::string name;   // unique in the cell
  std::string group;  // SRDF group that forms the arm
  // Home positions (rad, m) in group order. If empty, home_state applies. If both are empty, the
  // home of each joint is zero, clamped to its limits.
  std::vector<double> home;
  std::string home_state;                                // a state of the group in the SRDF
  std::map<std::string, JointLimitsDescription> limits;  // by URDF joint name
  // Start positions (rad, m) of gripper joints by URDF name. Other gripper joints start at zero,
  // clamped to their limits.
  std::map<std::string, double> gripper = {};
  std::optional<PayloadDescription> payload = {};
};

// Permitted values are declared next to each setting, as <setting>_range. The cell file reader, its
// schema and build_cell() use them.
inline constexpr NumberRange kSettingTime_s{0.0, 1e6};
inline constexpr NumberRange kSettingPositiveTime_s{0.0, 1e6, true};
inline constexpr NumberRange kZeroToOne{0.0, 1.0};

// A robot's controller: how to reach it, and what it promises. Certificates, authority and time
// limits rest on the promises; the monitor observes that they are kept.
struct ControllerDescription {
  inline static constexpr NumberRange lag_range = kSettingTime_s;
  inline static constexpr NumberRange noise_range = kZeroToOne;
  inline static constexpr NumberRange reaction_range{0.0, 1.0};
  inline static constexpr NumberRange feedback_period_range{0.001, 1.0};
  inline static constexpr NumberRange feedback_timeout_range{0.002, 10.0};

  std::string type = "sim";
  // Simulated arms only.
  Duration lag = std::chrono::milliseconds(20);  // first-order delay along the path
  double noise_rad = 0.0;                        // standard deviation of measured positions
  // Type "remote" only: "unix:PATH" or "tcp:HOST:PORT".
  std::string endpoint = {};

  // Promises.
  Duration reaction = std::chrono::milliseconds(20);  // from a command to its effect
  Duration feedback_period = std::chrono::milliseconds(1);
  Duration feedback_timeout = std::chrono::milliseconds(100);  // older feedback: the arm is lost
  std::optional<double> tracking_error_rad = {};  // nullopt: CheckingSettings::tracking_error_rad
};

struct RobotDescription {
  std::string name;
  std::string urdf;          // path, resolved against the folder of the cell file
  std::string srdf;          // path, resolved like urdf
  std::string joint_limits;  // path of MoveIt's joint_limits.yaml; may be empty
  std::string prefix;        // prepended to the URDF's joint and link names
  // Prepended to the joint and link names in the SRDF, and to the joint names in joint_limits, if
  // only the URDF has this prefix.
  std::string srdf_prefix = {};
  std::string joint_limits_prefix = {};
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  // base link in the world
  std::map<std::string, std::string> packages;             // package:// name -> folder
  // Positions (rad or m) at which joints are fixed, by URDF name. These are not joints of the cell.
  std::map<std::string, double> fixed;
  std::vector<ArmDescription> arms;
  ControllerDescription controller;
};

// Mass of an object. `center`: the center of mass in the object's frame (m).
struct Mass {
  inline static constexpr NumberRange range{0.0, 1e5};

  double kg = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();

  bool operator==(const Mass&) const = default;
};

struct ObjectDescription {
  std::string name;
  Shape shape;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  Mass mass = {};
};

struct CheckingSettings {
  inline static constexpr NumberRange time_step_range{1e-4, 10.0};
  inline static constexpr NumberRange tracking_error_range = kZeroToOne;
  inline static constexpr NumberRange delay_range = kSettingTime_s;
  inline static constexpr NumberRange limit_tolerance_range{
      .lowest = 0.0, .highest = 1.0, .open_above = true};

  Duration time_step = std::chrono::milliseconds(50);
  double tracking_error_rad = 0.001;
  Duration delay = std::chrono::milliseconds(100);
  double limit_tolerance = 0.05;  // share by which a spline may overshoot a limit
};
// Reaction to an idle arm that blocks a job, and to jobs that wait for each other.
enum class OnIdleBlocker {
  report,  // only report it
  park,    // move an arm out of the way (retreat)
  replan,  // plan a path around the arm; if there is none, park
};
[[nodiscard]] constexpr const char* to_string(OnIdleBlocker what) {
  switch (what) {
    case OnIdleBlocker::report:
      return "report";
    case OnIdleBlocker::park:
      return "park";
    case OnIdleBlocker::replan:
      return "replan";
  }
  return nullptr;
}

// Handling of unfinished jobs when the server is restarted.
enum class OnRestart {
  ask,       // they wait until an operator resumes them
  continue_  // jobs that had not begun continue automatically
};
[[nodiscard]] constexpr const char* to_string(OnRestart what) {
  switch (what) {
    case OnRestart::ask:
      return "ask";
    case OnRestart::continue_:
      return "continue";
  }
  return nullptr;
}

struct SchedulingSettings {
  inline static constexpr NumberRange backlog_timeout_range = kSettingPositiveTime_s;
  inline static constexpr NumberRange aging_range = kSettingTime_s;
  inline static constexpr NumberRange horizon_steps_range{1, 32};

  std::string policy = "earliest_start";
  Duration backlog_timeout = std::chrono::seconds(60);
  Duration aging = std::chrono::seconds(30);
  OnIdleBlocker on_idle_blocker = OnIdleBlocker::park;
  int horizon_steps = 12;  // motions per arm that look-ahead policies admit in advance
  OnRestart on_restart = OnRestart::ask;
};
struct MonitorSettings {
  inline static constexpr NumberRange rate_range{1.0, 1000.0};  // Hz
  inline static constexpr NumberRange reaction_range = kSettingTime_s;
  inline static constexpr NumberRange stop_clearance_range = kZeroToOne;  // and <= clearance_m

  double rate_hz = 100.0;
  Duration reaction = std::chrono::milliseconds(20);
  double stop_clearance_m = 0.01;
};
inline constexpr double kVelocityScalingMin = 1e-3;

struct ExecutionSettings {  // MoveIt's defaults
  inline static constexpr NumberRange start_tolerance_range{0.0, 1.0, true};
  inline static constexpr NumberRange duration_scaling_range{1.0, 100.0};
  inline static constexpr NumberRange duration_margin_range = kSettingTime_s;
  inline static constexpr NumberRange velocity_scaling_range{kVelocityScalingMin, 1.0};

  double start_tolerance_rad = 0.01;
  double duration_scaling = 1.1;
  Duration duration_margin = std::chrono::milliseconds(500);
  // Default share of the joint velocities, in (0, 1], for motions timed by the server.
  double velocity_scaling_factor = 1.0;
};

struct CellDescription {
  inline static constexpr NumberRange clearance_range = kZeroToOne;  // m; for all three clearances

  std::string name;
  std::vector<RobotDescription> robots;
  std::vector<ObjectDescription> objects;
  std::vector<std::pair<std::string, std::string>> allowed_collisions;  // link or object names
  double clearance_m = 0.02;
  // Clearance between the links of one arm, which pass each other closely by design.
  double self_clearance_m = 0.005;
  // Clearance between an arm and its mount. If nullopt, clearance_m applies.
  std::optional<double> mount_clearance_m;
  CheckingSettings checking;
  SchedulingSettings scheduling;
  MonitorSettings monitor;
  ExecutionSettings execution;
  IoDescription io;
};

}  // namespace armloom
