#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/base/ids.h"
#include "core/model/cell.h"

namespace armloom {

// An object attached to a link: it moves with the link and is not part of the scene.
struct Attachment {
  CollisionObject object;  // its X_WO is not used
  LinkId link;             // moved by an arm
  Eigen::Isometry3d X_LO = Eigen::Isometry3d::Identity();
  std::vector<LinkId> touch;  // of any robot; may be touched besides the hand
};

// Returns for each LinkId whether the link belongs to the hand of `link`: links fixed to it, or
// moved relative to it only by its arm's gripper joints; includes `link` itself. These links may
// touch objects that `link` carries, and objects carried by two of them may touch. Precondition: an
// arm moves `link`.
[[nodiscard]] std::vector<bool> hand_of(const Cell& cell, LinkId link);

}  // namespace armloom
