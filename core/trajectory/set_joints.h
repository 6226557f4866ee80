#pragma once

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// The trajectory's joints stand at `position` (in its order) of the configuration; all others as
// they did.
inline void set_joints(Configuration& q, const Trajectory& trajectory,
                       const Eigen::VectorXd& position) {
  for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
    q[static_cast<Eigen::Index>(trajectory.joints()[j].index())] =
        position[static_cast<Eigen::Index>(j)];
  }
}

}  // namespace armloom
