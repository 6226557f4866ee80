#pragma once

#include <optional>

#include "core/collision/check/motion_checker.h"

namespace armloom {

// The motion checker of one thread. in() creates it at the first call, and then sets the scene of
// the present question.
class OwnChecker {
 public:
  [[nodiscard]] MotionChecker& in(const PlanningScenePtr& scene) {
    if (!checker_) checker_.emplace(scene);
    checker_->look_at(scene);
    return *checker_;
  }

 private:
  std::optional<MotionChecker> checker_;
};

}  // namespace armloom
