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

namespace armloom {

// A cell file as plain data, before anything in it has been checked against the robots' URDFs.
// Defaults here are the documented defaults of the file. Names are as the file spells them.

// Of one joint, as the cell gives them; absent: the robot's joint_limits file, then the URDF, then
// the stated default decides.
struct JointLimitsDescription {
  std::optional<double> lower;         // rad (m): not below the URDF's
  std::optional<double> upper;         // rad (m): not above the URDF's
  std::optional<double> velocity;      // rad/s (m/s): not above the URDF's
  std::optional<double> acceleration;  // rad/s^2 (m/s^2), default kDefaultAcceleration
  std::optional<double> jerk;          // rad/s^3 (m/s^3), default kDefaultJerk
  std::optional<double> brake;         // rad/s^2 (m/s^2), default twice the acceleration
  // The keys by which the cell file gave them, as velocity_m_s: the units have to fit the joint.
  std::set<std::string> keys = {};
};
inline constexpr double kDefaultVelocity = 1.0;  // of joints that no arm's group holds, as MoveIt's
inline constexpr double kDefaultAcceleration = 3.75;
inline constexpr double kDefaultJerk = 7500.0;

struct ArmDescription {
  std::string name;   // unique in the cell
  std::string group;  // SRDF group (a chain, or joints) that the arm consists of
  // Group order; empty: as home_state says, and if that is empty too, every joint at zero, clamped
  // to its limits.
  std::vector<double> home;
  std::string home_state;  // a state of the group by its name in the SRDF
  std::map<std::string, JointLimitsDescription> limits;  // by URDF joint name, without prefix
  // Where joints of the gripper stand at the start, by URDF joint name (rad, m); others at zero,
  // clamped to their limits.
  std::map<std::string, double> gripper = {};
};

// What settings may be stands beside them, as <setting>_range: the reader of cell files, their
// schema and build_cell() take it from here.
inline constexpr NumberRange kSettingTime_s{0.0, 1e6};
inline constexpr NumberRange kSettingPositiveTime_s{0.0, 1e6, true};
inline constexpr NumberRange kZeroToOne{0.0, 1.0};

struct ControllerDescription {
  inline static constexpr NumberRange lag_range = kSettingTime_s;
  inline static constexpr NumberRange noise_range = kZeroToOne;

  std::string type = "sim";
  Duration lag = std::chrono::milliseconds(20);  // first-order delay along the path
  double noise_rad = 0.0;                        // standard deviation of measured positions
};

struct RobotDescription {
  std::string name;
  std::string urdf;          // path, resolved against the folder of the cell file
  std::string srdf;          // the same
  std::string joint_limits;  // path of a MoveIt joint_limits.yaml, the same; empty: none
  std::string prefix;        // joint, link names in the cell are prefix + URDF name
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  // base link in the world
  std::map<std::string, std::string> packages;             // package:// name -> folder
  // Joints that are held at a value, by URDF name (rad or m): they are no joints of the cell.
  std::map<std::string, double> fixed;
  std::vector<ArmDescription> arms;
  ControllerDescription controller;
};

struct ObjectDescription {
  std::string name;
  Shape shape;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
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
// What is done about an arm without a job in the way of one, and jobs that wait for each other.
enum class OnIdleBlocker {
  report,  // it is only told
  park,    // an arm is sent aside
  replan,  // the job is planned around it; where there is no such way, as park
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

// What a server that is started again does with jobs that had not ended when it did.
enum class OnRestart {
  ask,       // they wait until someone says go on
  continue_  // those that had not begun go on by themselves
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
  int horizon_steps = 12;  // of each lane, admitted ahead by policies that look ahead
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
  // Of motions whose times are made here, where nobody says another one: a share of the joints'
  // speeds in (0, 1].
  double velocity_scaling_factor = 1.0;
};

struct CellDescription {
  inline static constexpr NumberRange clearance_range = kZeroToOne;  // m, of all three

  std::string name;
  std::vector<RobotDescription> robots;
  std::vector<ObjectDescription> objects;
  std::vector<std::pair<std::string, std::string>> allowed_collisions;  // link or object names
  double clearance_m = 0.02;
  // Of an arm's own links, which pass each other closely by design.
  double self_clearance_m = 0.005;
  // Of an arm from the link that it is mounted on (Cell::is_mount); absent: clearance_m.
  std::optional<double> mount_clearance_m;
  CheckingSettings checking;
  SchedulingSettings scheduling;
  MonitorSettings monitor;
  ExecutionSettings execution;
};

}  // namespace armloom
