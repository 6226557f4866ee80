#pragma once

#include <memory>

#include "core/model/cell.h"

namespace armloom::bench {

// "FCL the MoveIt way", the baseline: what MoveIt's planning scene does with FCL to check one state
// of all robots (checkCollision of its collision_env_fcl, without contacts). Per state:
// - forward kinematics, and for each link a placed copy of its collision object;
// - a dynamic AABB-tree manager of these objects;
// - the world's manager against it, and if nothing was found the manager against itself;
// - for each pair of overlapping boxes, a callback that skips allowed pairs and otherwise collides
//   the two meshes, until the first contact.
// Built once: a mesh of about 250 triangles per link (circumscribed_mesh) as
// fcl::BVHModel<fcl::OBBRSS>, and the world's manager. Cheaper than MoveIt: allowed pairs are
// indexed by number, and a state has no attached bodies. Not thread-safe.
class MoveItWay {
 public:
  // Precondition (throws std::invalid_argument): the cell's objects are boxes.
  explicit MoveItWay(CellPtr cell);
  MoveItWay(MoveItWay&&) noexcept;
  MoveItWay& operator=(MoveItWay&&) noexcept;
  ~MoveItWay();

  // Returns true if any two checked bodies touch, except allowed pairs and pairs that no arm moves.
  // True whenever the exact shapes touch, and for some states millimeters apart. Precondition: q
  // has one entry per joint of the cell.
  [[nodiscard]] bool in_collision(const Configuration& q);

  [[nodiscard]] std::size_t triangles() const;  // of all links together
  [[nodiscard]] std::size_t meshes() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace armloom::bench
