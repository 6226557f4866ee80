#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/base/problem.h"
#include "server/physics/link_inertia.h"

namespace armloom {

// Dynamics of a joint as given by the URDF; N m for revolute joints, N for prismatic joints.
struct JointDynamics {
  std::optional<double> effort_max;  // > 0; nullopt if missing or 0
  double damping = 0.0;              // per rad/s or m/s
  double friction = 0.0;             // dry friction
};

// The parts of a URDF that matter only for dynamics. Names are without the robot's prefix.
struct RobotDynamics {
  std::map<std::string, LinkInertia> links;     // that have a possible <inertial>
  std::map<std::string, JointDynamics> joints;  // by the name of the child link
};

// Reads <inertial>, <dynamics> and the effort of <limit>. Values that are faulty or physically
// impossible are left out, with a warning that names the link or joint. `robot`: for warnings.
[[nodiscard]] RobotDynamics read_dynamics(const std::string& urdf_text, const std::string& robot,
                                          Problems& warnings);

}  // namespace armloom
