#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/geometry/shape.h"
#include "core/model/cell.h"

namespace armloom {

// What the URDF says of how a joint may move; whether that is enough depends on whose joint it is.
struct UrdfLimits {
  std::optional<double> lower;  // rad or m; none: absent, or no number
  std::optional<double> upper;
  std::optional<double>
      velocity;        // > 0; none: absent, no number, or 0, which says nothing (MoveIt)
  Diagnostics faults;  // numbers that are none, limits that cross
};

// One robot as its URDF describes it: plain data between the reader and the cell. Names are without
// prefix. A joint is known by the index of the link that it moves.
struct TreeJoint {
  struct Mimic {
    std::size_t driver;  // link whose joint is followed; that joint is movable and no mimic itself
    double multiplier;
    double offset;
  };

  std::string name;                 // empty: of the root
  std::optional<JointKind> motion;  // none: fixed, or of the root
  bool many_values = false;         // floating or planar: fixed at its origin
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // unit
  std::optional<Mimic> mimic;
  UrdfLimits limits;
  // By the cell file's "fixed", or as a mimic of multiplier 0: rad or m, which X_PJ then contains.
  std::optional<double> held;
  int line = 0;  // in the file

  // With a value of its own: it becomes a Joint of the cell.
  [[nodiscard]] bool is_independent() const { return motion.has_value() && !mimic.has_value(); }
};
struct TreeLink {
  std::string name;
  std::optional<std::size_t> parent;  // smaller than the own index; none: root
  TreeJoint joint;                    // the one above
  std::vector<PlacedShape> shapes;
  bool seen = false;   // it has a <visual>
  bool solid = false;  // it has a <collision>, which may be faulty
  int line = 0;        // in the file

  [[nodiscard]] bool is_rigid() const { return !joint.motion.has_value(); }  // to its parent
};

struct RobotTree {
  std::string name;  // of the robot, as the file has it
  std::string file;  // file name without folder, as places name it
  std::string text;
  std::vector<TreeLink> links;                  // depth first: parents before children
  std::map<std::string, std::size_t> by_link;   // link name -> index
  std::map<std::string, std::size_t> by_joint;  // joint name -> index of the link that it moves
  // What hangs where is wrong in the file and was told: links may hang elsewhere than meant, so
  // what follows from that need not be told again.
  bool patched = false;
  // A link or joint of it has no name: what other files name may be that one.
  bool nameless = false;

  // "arm.urdf:12: link forearm"; of the joint above the link "arm.urdf:17: joint elbow".
  [[nodiscard]] std::string place_of_link(const TreeLink& link) const {
    return file + ":" + std::to_string(link.line) + ": link " + link.name;
  }
  [[nodiscard]] std::string place_of_joint(const TreeLink& link) const {
    return file + ":" + std::to_string(link.joint.line) + ": joint " + link.joint.name;
  }
};

}  // namespace armloom
