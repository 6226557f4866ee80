#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "core/collision/scene/scene_bodies.h"

namespace armloom::soundness {

// Distances of parts by FCL alone, in double: its own shapes made anew from the bodies' sizes, no
// bounds and no proofs before or behind it. What the engine's distances are held against.
class PlainFcl {
 public:
  explicit PlainFcl(const PlanningScene::Bodies& bodies);
  ~PlainFcl();

  // The smallest distance over the parts' bodies; zero or negative in contact, and zero where FCL
  // throws.
  [[nodiscard]] double distance(std::size_t body_a, const Eigen::Isometry3d& X_WA,
                                std::size_t body_b, const Eigen::Isometry3d& X_WB) const;

 private:
  struct Shapes;
  const PlanningScene::Bodies& bodies_;
  std::unique_ptr<Shapes> shapes_;
};

}  // namespace armloom::soundness
