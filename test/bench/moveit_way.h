#pragma once

#include <memory>

#include "core/model/cell.h"

namespace armloom::bench {

// "FCL the MoveIt way", the baseline of the benchmarks: what MoveIt's planning scene does with FCL
// to check whether one state of all robots is in collision (checkCollision of its
// collision_env_fcl, without contacts). Per state:
// - forward kinematics;
// - for each link, a placed copy of its collision object;
// - a dynamic AABB-tree manager of these objects;
// - the world's manager against it, and if nothing was found the manager against itself;
// - for each pair of overlapping boxes, a callback that skips allowed pairs and otherwise collides
//   the two meshes.
// The check ends at the first contact. Built once for all states: a mesh of about 250 triangles per
// link (circumscribed_mesh) as fcl::BVHModel<fcl::OBBRSS>, and the world's manager with the cell's
// objects. Cheaper than MoveIt in two points: the matrix is indexed by number instead of two names,
// and a state has no vectors of attached bodies. Not thread-safe: use one object per thread.
class MoveItWay {
 public:
  // Precondition (throws std::invalid_argument): the cell's objects are boxes.
  explicit MoveItWay(CellPtr cell);
  MoveItWay(MoveItWay&&) noexcept;
  MoveItWay& operator=(MoveItWay&&) noexcept;
  ~MoveItWay();

  // Returns true if any two checked bodies touch: links of different arms, links of one arm, links
  // and objects. Allowed pairs and pairs that no arm moves are skipped. True whenever the exact
  // shapes touch, and for some states in which they are millimeters apart. Precondition: q has one
  // entry per joint of the cell.
  [[nodiscard]] bool in_collision(const Configuration& q);

  [[nodiscard]] std::size_t triangles() const;  // of all links together
  [[nodiscard]] std::size_t meshes() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace armloom::bench
