#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/model/cell.h"

namespace armloom {

// An object attached to a link: it moves with the link and is not part of the scene.
struct Attachment {
  CollisionObject object;  // its X_WO is not used
  LinkId link;             // carries the object; an arm moves this link
  Eigen::Isometry3d X_LO = Eigen::Isometry3d::Identity();
  std::vector<LinkId> touch;  // links of any robot that the object may touch besides the hand
  std::vector<std::string> touch_objects = {};  // objects of the scene that it may touch
  // Hands of other arms that hold it too, and may touch it. The object moves with `link` in every
  // check: these arms move only together.
  struct Other {
    LinkId link;
    Eigen::Isometry3d X_LO = Eigen::Isometry3d::Identity();
  };
  std::vector<Other> others = {};
};

// Links that may touch an object of the scene at present, besides those that the cell file allows.
struct AllowedTouch {
  std::string object;
  std::vector<LinkId> links;

  bool operator==(const AllowedTouch&) const = default;
};

// Returns, indexed by LinkId, true for each link of the hand to which `link` belongs. The hand is
// `link` itself and all links connected to it by fixed joints or its arm's gripper joints only.
// Links of the hand may touch the objects that `link` carries. Objects carried by two links of one
// hand may touch each other. Precondition: an arm moves `link`.
[[nodiscard]] std::vector<bool> hand_of(const Cell& cell, LinkId link);

}  // namespace armloom
