#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/base/ids.h"
#include "core/model/cell.h"

namespace armloom {

// An object that an arm holds: it moves with the link and is no object of the scene.
struct Attachment {
  CollisionObject object;  // its X_WO is not used
  LinkId link;             // moved by an arm
  Eigen::Isometry3d X_LO = Eigen::Isometry3d::Identity();
  std::vector<LinkId> touch;  // links of any robot that it may touch besides the hand that holds it
};

// The links that hold what `link` carries, by LinkId: those that stand still against it, or are
// moved against it by its arm's gripper joints only, `link` among them. They may touch what it
// carries, and things carried by two of them may touch. Precondition: the link is moved by an arm.
[[nodiscard]] std::vector<bool> hand_of(const Cell& cell, LinkId link);

}  // namespace armloom
