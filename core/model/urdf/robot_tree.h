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

// Joint limits in the URDF. The joint's role in the cell decides which limits it needs.
struct UrdfLimits {
  std::optional<double> lower;  // rad or m; nullopt if not a number
  std::optional<double> upper;
  std::optional<double> velocity;  // > 0; nullopt if not a number, or 0 (as in MoveIt)
  Diagnostics faults;              // faulty numbers, crossed limits
};

// One robot as described by its URDF. Names have no prefix. A joint has the index of the link that
// it moves.
struct TreeJoint {
  struct Mimic {
    std::size_t driver;  // index of the followed joint, which is movable and not a mimic
    double multiplier;
    double offset;
  };

  std::string name;                 // empty for the root
  std::optional<JointKind> motion;  // nullopt if fixed, or for the root
  bool many_values = false;         // floating or planar: fixed at its origin
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // unit
  std::optional<Mimic> mimic;
  UrdfLimits limits;
  // Position of a joint that is fixed by the cell file or by a mimic multiplier of 0 (rad or m).
  // X_PJ already includes it.
  std::optional<double> held;
  int line = 0;  // in the file

  // Returns true if the joint becomes a Joint of the cell.
  [[nodiscard]] bool is_independent() const { return motion.has_value() && !mimic.has_value(); }
};
struct TreeLink {
  std::string name;
  std::optional<std::size_t> parent;  // smaller than the own index; nullopt for the root
  TreeJoint joint;                    // the joint that moves this link
  std::vector<PlacedShape> shapes;
  bool seen = false;   // it has a <visual>
  bool solid = false;  // it has a <collision>, which may be faulty
  int line = 0;        // in the file

  // Returns true if the link is fixed to its parent.
  [[nodiscard]] bool is_rigid() const { return !joint.motion.has_value(); }
};

struct RobotTree {
  std::string name;  // of the robot
  std::string file;  // file name as in messages, without folder
  std::string text;
  std::vector<TreeLink> links;                  // depth first: parents before children
  std::map<std::string, std::size_t> by_link;   // link name -> index
  std::map<std::string, std::size_t> by_joint;  // joint name -> index
  // True if the file's structure has faults, which were reported. Links may then be misplaced, so
  // faults that may follow from this are not reported.
  bool patched = false;
  // True if a link or joint has no name, or if the file could not be read. Unknown names in other
  // files may then be its name.
  bool nameless = false;

  // Return the place of the link ("arm.urdf:12: link forearm") and of the joint that moves it
  // ("arm.urdf:17: joint elbow").
  [[nodiscard]] std::string place_of_link(const TreeLink& link) const {
    return file + ":" + std::to_string(link.line) + ": link " + link.name;
  }
  [[nodiscard]] std::string place_of_joint(const TreeLink& link) const {
    return file + ":" + std::to_string(link.joint.line) + ": joint " + link.joint.name;
  }
};

}  // namespace armloom
