#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "core/collision/scene/scene_bodies.h"

namespace armloom::soundness {

// Distances of bodies by FCL alone, in double: own shapes built from the bodies' sizes, without the
// engine's bounds and proofs. Reference for the engine's distances.
class PlainFcl {
 public:
  explicit PlainFcl(const PlanningScene::Bodies& bodies);
  ~PlainFcl();

  // Returns the smallest distance over the bodies' shapes; zero or negative in contact, and zero if
  // FCL throws.
  [[nodiscard]] double distance(std::size_t body_a, const Eigen::Isometry3d& X_WA,
                                std::size_t body_b, const Eigen::Isometry3d& X_WB) const;

 private:
  struct Shapes;
  const PlanningScene::Bodies& bodies_;
  std::unique_ptr<Shapes> shapes_;
};

}  // namespace armloom::soundness
