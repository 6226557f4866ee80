#pragma once

#include <memory>

#include "core/model/cell.h"

namespace armloom::bench {

// "FCL the MoveIt way", the baseline of the benchmarks: what MoveIt's planning scene does with FCL
// when asked whether one state of all robots is in collision (checkCollision of its
// collision_env_fcl, no contacts wanted). Per state: forward kinematics; for each link a copy of
// its collision object put in place; a dynamic AABB-tree manager built of them; the world's manager
// against it, and if nothing was found the manager against itself; each pair of boxes that overlap
// goes to a callback which skips what the allowed-collision matrix allows and else collides the two
// meshes. It ends at the first contact.
// Kept as the same, once for all states: a mesh of some 250 triangles for each link
// (circumscribed_mesh) as fcl::BVHModel<fcl::OBBRSS>, and the world's manager with the cell's
// objects. Cheaper than MoveIt in that the matrix is looked up by index and not by two names, and
// in that a state brings no vectors of attached bodies.
// Not thread-safe: one per thread.
class MoveItWay {
 public:
  // Precondition (throws std::invalid_argument): the cell's objects are boxes.
  explicit MoveItWay(CellPtr cell);
  MoveItWay(MoveItWay&&) noexcept;
  MoveItWay& operator=(MoveItWay&&) noexcept;
  ~MoveItWay();

  // Whether any two bodies touch that the scene looks at: links of different arms, of one arm,
  // links and objects; allowed pairs and pairs that no arm moves are left out. True whenever the
  // exact shapes touch, and for some states where they are millimetres apart.
  // Precondition: q has one entry per joint of the cell.
  [[nodiscard]] bool in_collision(const Configuration& q);

  [[nodiscard]] std::size_t triangles() const;  // of all links together
  [[nodiscard]] std::size_t meshes() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace armloom::bench
