#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/model/shape.h"

namespace armloom {

// One robot as its URDF describes it: plain data between the reader and the cell. Names are without
// prefix. A joint is known by the index of the link that it moves.
struct TreeLink {
  struct Mimic {
    std::size_t driver;  // link whose joint is followed; that joint is movable and no mimic itself
    double multiplier;
    double offset;
  };

  std::string name;
  std::optional<std::size_t> parent;  // smaller than the own index; none: root
  std::string joint;                  // name of the joint above; empty for the root
  std::optional<JointKind> motion;    // none: fixed, or root
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // unit
  std::optional<Mimic> mimic;
  double lower = 0.0;  // rad or m; -inf/+inf for continuous joints
  double upper = 0.0;
  double velocity_max = 0.0;
  std::vector<PlacedShape> shapes;

  // A joint with a value of its own: it becomes a Joint of the cell.
  [[nodiscard]] bool is_independent() const { return motion.has_value() && !mimic.has_value(); }
  [[nodiscard]] bool is_rigid() const { return !motion.has_value(); }  // to its parent
};

struct RobotTree {
  std::string file;  // file name without folder, as places name it
  std::string text;
  std::vector<TreeLink> links;                  // depth first: parents before children
  std::map<std::string, std::size_t> by_link;   // link name -> index
  std::map<std::string, std::size_t> by_joint;  // joint name -> index of the link that it moves
};

}  // namespace armloom
