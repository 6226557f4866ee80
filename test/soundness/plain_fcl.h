#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "core/collision/scene/scene_bodies.h"

namespace armloom::soundness {

// Reference distances by FCL alone, in double precision. Builds its own shapes, and uses no bounds
// and proofs of the engine.
class PlainFcl {
 public:
  explicit PlainFcl(const PlanningScene::Bodies& bodies);
  ~PlainFcl();

  // Returns the smallest distance over the bodies' shapes; at most zero in contact or if FCL
  // throws.
  [[nodiscard]] double distance(std::size_t body_a, const Eigen::Isometry3d& X_WA,
                                std::size_t body_b, const Eigen::Isometry3d& X_WB) const;

 private:
  struct Shapes;
  const PlanningScene::Bodies& bodies_;
  std::unique_ptr<Shapes> shapes_;
};

}  // namespace armloom::soundness
