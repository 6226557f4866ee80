#include "core/executive/start_elsewhere.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "core/base/rounding_noise.h"
#include "core/base/whole_turns.h"

namespace armloom {

void find_start_elsewhere(const Cell& cell, const Trajectory& trajectory, const Configuration& rest,
                          Problems& problems) {
  for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
    const Joint& joint = cell.joint(trajectory.joints()[j]);
    const double begins = trajectory.start()[static_cast<Eigen::Index>(j)];
    const double stands = rest[static_cast<Eigen::Index>(trajectory.joints()[j].index())];
    if (std::abs(begins - stands) <= cell.execution.start_tolerance_rad) continue;
    char text[256];
    std::snprintf(
        text, sizeof text,
        "waypoint 0, %s: begins at %.6g %s, but the joint will be at %.6g %s after the jobs "
        "accepted for the arm",
        joint.name.c_str(), without_rounding_noise(begins), joint.unit().c_str(),
        without_rounding_noise(stands), joint.unit().c_str());
    std::string detail = text;
    if (joint.kind != JointKind::prismatic)
      detail += whole_turns_apart(stands, begins, cell.execution.start_tolerance_rad);
    problems.push_back({ProblemKind::invalid, "start-mismatch",
                        "/points/0/positions/" + std::to_string(j), std::move(detail), begins});
  }
}

}  // namespace armloom
