#pragma once

#include <map>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Holds where clients left the arms that have retreated since, and the motions back. Clients
// need not know about retreats. A copy is independent of the original.
class WaysBack {
 public:
  // The arm has no client job, and retreats along `way`.
  void retreat(ArmId arm, const Trajectory& way);
  // A client submits this motion; the jobs before it leave all joints at `rest`. Returns motions
  // that first bring its arms back, if more of its joints then stand where it begins, and sets
  // `rest` to their ends. Forgets the ways back of arms that return or that the motion moves away.
  std::vector<TrajectoryPtr> take(const Cell& cell, const Trajectory& motion, Configuration& rest);

 private:
  std::map<ArmId, TrajectoryPtr> by_arm_;
};

}  // namespace armloom
