#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/validate.h"

namespace armloom::testing {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Limits {
  double lower, upper, velocity_max;
  double acceleration_max = 3.75;
};
inline JointId add_joint(Cell& cell, const std::string& name, std::optional<ArmId> arm,
                         JointKind kind, const Limits& limits) {
  cell.joints.push_back({name, RobotId(0), arm, kind, limits.lower, limits.upper,
                         limits.velocity_max, limits.acceleration_max, 7500.0,
                         2.0 * limits.acceleration_max});
  return JointId(static_cast<std::uint32_t>(cell.joints.size() - 1));
}

// Adds seven joints with a Panda's limits and one finger.
inline void add_panda(Cell& cell, const std::string& name) {
  const Limits panda[] = {{-2.8973, 2.8973, 2.175}, {-1.7628, 1.7628, 2.175},
                          {-2.8973, 2.8973, 2.175}, {-3.0718, -0.0698, 2.175},
                          {-2.8973, 2.8973, 2.61},  {-0.0175, 3.7525, 2.61},
                          {-2.8973, 2.8973, 2.61}};
  const ArmId id(static_cast<std::uint32_t>(cell.arms.size()));
  Arm arm{name, RobotId(0), "panda_arm", {}, {}, {}, Eigen::VectorXd::Zero(7), {}};
  for (int i = 0; i < 7; ++i) {
    arm.joints.push_back(add_joint(cell, name + "_panda_joint" + std::to_string(i + 1), id,
                                   JointKind::revolute, panda[i]));
  }
  arm.gripper_joints.push_back(add_joint(cell, name + "_panda_finger_joint1", id,
                                         JointKind::prismatic, {0.0, 0.04, 0.2, 1.0}));
  cell.arms.push_back(arm);
}

// Adds an arm with symmetric limits: 2.8 rad, 2 rad/s, 4 rad/s^2.
inline void add_pair_arm(Cell& cell) {
  const ArmId id(static_cast<std::uint32_t>(cell.arms.size()));
  Arm arm{"pair", RobotId(0), "pair", {}, {}, {}, Eigen::VectorXd::Zero(2), {}};
  for (const char* name : {"pair_a", "pair_b"}) {
    arm.joints.push_back(add_joint(cell, name, id, JointKind::revolute, {-2.8, 2.8, 2.0, 4.0}));
  }
  cell.arms.push_back(arm);
}

// Arms left, right (Pandas, ids 0 and 1), pair (2), wheel (3: one continuous joint), lift (4: one
// prismatic joint, 0..1 m, 0.5 m/s, 2 m/s^2), and a joint "loose_hinge" of no arm.
inline Cell test_cell() {
  Cell cell;
  cell.name = "test";
  cell.checking.limit_tolerance = 0.05;
  add_panda(cell, "left");
  add_panda(cell, "right");
  add_pair_arm(cell);
  for (const bool turns : {true, false}) {
    const ArmId id(static_cast<std::uint32_t>(cell.arms.size()));
    const std::string name = turns ? "wheel" : "lift";
    const JointId joint =
        turns ? add_joint(cell, name, id, JointKind::continuous, {-kInfinity, kInfinity, 2.0, 4.0})
              : add_joint(cell, name, id, JointKind::prismatic, {0.0, 1.0, 0.5, 2.0});
    cell.arms.push_back({name, RobotId(0), name, {joint}, {}, {}, Eigen::VectorXd::Zero(1), {}});
  }
  add_joint(cell, "loose_hinge", std::nullopt, JointKind::revolute, {-1.0, 1.0, 1.0, 1.0});
  return cell;
}

inline std::vector<std::string> panda_joint_names(const std::string& arm) {
  std::vector<std::string> names;
  for (int i = 1; i <= 7; ++i) names.push_back(arm + "_panda_joint" + std::to_string(i));
  return names;
}

// Returns a valid motion of a Panda near home: `count` waypoints, 0.1 s apart, without
// accelerations; all joints move up to 0.05 rad and back.
inline TrajectoryRequest quiet_panda_request(const std::string& arm, std::size_t count = 20) {
  const std::vector<double> home = {0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785};
  TrajectoryRequest request{panda_joint_names(arm), {}};
  const double duration_s = 0.1 * static_cast<double>(count - 1);
  const double omega = 2.0 * 3.14159265358979323846 / duration_s;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = 0.1 * static_cast<double>(k);
    WaypointRequest point;
    for (std::size_t j = 0; j < 7; ++j) {
      const double swing_rad = 0.05 - 0.01 * static_cast<double>(j);
      point.positions.push_back(home[j] + 0.5 * swing_rad * (1.0 - std::cos(omega * t)));
      point.velocities.push_back(0.5 * swing_rad * omega * std::sin(omega * t));
    }
    point.time_from_start_s = t;
    request.points.push_back(point);
  }
  return request;
}

struct Knot {
  double time_s;
  double position;
  double velocity;
};
inline TrajectoryRequest request_of(std::vector<std::string> names,
                                    const std::vector<Knot>& knots) {
  TrajectoryRequest request{std::move(names), {}};
  const std::size_t size = request.joint_names.size();
  for (const Knot& knot : knots) {
    request.points.push_back({std::vector<double>(size, knot.position),
                              std::vector<double>(size, knot.velocity),
                              {},
                              knot.time_s});
  }
  return request;
}

}  // namespace armloom::testing
