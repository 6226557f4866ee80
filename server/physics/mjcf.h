#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/model/cell.h"

namespace armloom {

// A mass at a link, without a shape.
struct Payload {
  std::string link;  // with prefix
  double mass_kg = 0.0;
  Eigen::Vector3d p_LC_m = Eigen::Vector3d::Zero();  // center of mass in the link's frame
};
inline constexpr double kPayloadRadius_m = 0.05;  // a solid sphere

// Assumptions that apply if the URDF has no value. Each use is reported by a warning.
inline constexpr double kAssumedDensity_kg_m3 = 600.0;  // of a link's shapes
inline constexpr double kAssumedEffort = 100.0;         // N m (N)
// Reflected inertia of a joint's motor, per N m (N) of its effort: kg m^2 (kg). URDF has no field
// for it. The motor alone could accelerate at 400 rad/s^2 (m/s^2).
inline constexpr double kArmaturePerEffort = 1.0 / 400.0;
// Smallest mass of a link that moves, so that the dynamics are defined.
inline constexpr double kLightestLink_kg = 1e-3;

// A link with a joint of its own: moved by a joint of the cell, directly or as a mimic.
struct DrivenLink {
  LinkId link;
  JointId driver;
  double multiplier = 1.0;  // position = multiplier * q[driver] + offset
  double offset = 0.0;
  double effort_max;      // N m (N)
  double friction = 0.0;  // N m (N)
};

// MuJoCo's description of robots and objects.
struct Mjcf {
  std::string text;
  std::vector<std::string> bodies;  // links and objects by name; "B<index>" in `text`
  std::vector<DrivenLink>
      driven;  // the joint is "J<index>" in `text`, its lock the equality <index>
};

struct MjcfOptions {
  std::optional<RobotId> robot;  // nullopt: all robots of the cell
  std::optional<Payload> payload;
  Duration time_step = std::chrono::microseconds(500);
  int contacts_max = 200;  // of pairs of shapes
  bool is_static = false;  // only contacts are computed, no dynamics: less memory
};

// Describes the robots and all objects of the cell. Pairs of bodies have no contact if the cell
// allows them to touch, if neither body moves with an arm, or if they are in one rigid body. Meshes
// are represented by their convex pieces. Assumptions are reported in `warnings`.
// Returns a Problem if a mesh has no data, or if the payload's link is unknown or its mass is not a
// positive number.
[[nodiscard]] Result<Mjcf> make_mjcf(const Cell& cell, const MjcfOptions& options,
                                     Problems& warnings);

}  // namespace armloom
