#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/collision/body.h"
#include "core/collision/capsule_fit.h"
#include "core/collision/planning_scene.h"
#include "core/model/cell.h"

namespace armloom {

// A link with shapes, or an object: what is placed as one, with its bodies.
struct Part {
  std::string name;
  std::optional<LinkId> link;    // none: an object
  std::optional<ArmId> arm;      // that moves it; none: it stands still
  std::optional<RobotId> robot;  // none: an object
  std::size_t bodies_begin = 0;  // range in Bodies::bodies
  std::size_t bodies_end = 0;
  Eigen::Vector3d p_PC = Eigen::Vector3d::Zero();  // centre and radius of its bounding sphere
  double radius_m = 0.0;
  bool lone_box = false;              // its only body is a box: a sphere says little about a table
  std::vector<LinkCapsule> capsules;  // one or two, in P; each body lies in one (link_capsules.h)
  double capsule_excess_m = 0.0;      // how far they stand off the bodies
};

// Two parts that must not touch. The first belongs to the group's first arm.
struct PartPair {
  std::size_t a;
  std::size_t b;
};

// All pairs of one counterpart: judged or skipped together.
struct PairGroup {
  enum class Kind {
    arms,   // links of two arms
    still,  // an arm against objects and the static links of other robots
    self,   // an arm against itself and the static links of its own robot
  };
  Kind kind;
  ArmId arm;
  std::optional<ArmId> other;   // Kind::arms only, and larger than arm
  std::size_t pairs_begin = 0;  // range in Bodies::pairs
  std::size_t pairs_end = 0;
};

// Pairs are in the order of their groups: arms by (arm, other), then still, then self by arm; in a
// group by link, then object.
struct PlanningScene::Bodies {
  CellPtr cell;
  std::vector<CollisionObject> objects;
  std::vector<Part> parts;    // links in the order of their ids, then objects
  std::size_t links_end = 0;  // parts before it are links
  std::vector<Body> bodies;
  std::vector<PartPair> pairs;
  std::vector<PairGroup> groups;
  std::vector<std::vector<std::size_t>> parts_of_arm;  // by ArmId
};

}  // namespace armloom
