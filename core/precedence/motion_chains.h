#pragma once

#include <cstddef>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/precedence/coordinated_motion.h"

namespace armloom {

// Tells which motions follow each other on shared arms, in list order. Motions are given as indices
// into the list.
class MotionChains {
 public:
  explicit MotionChains(const std::vector<CoordinatedMotion>& motions);

  // Returns the motions that directly precede this motion on its arms, each once.
  [[nodiscard]] const std::vector<std::size_t>& before(std::size_t motion) const {
    return before_[motion];
  }
  // Returns true if one of the motion's arms has no earlier motion, so that it is at the start now.
  [[nodiscard]] bool stands(std::size_t motion) const { return stands_[motion]; }
  // Returns true if each of the motion's arms has a later motion.
  [[nodiscard]] bool moves_on(std::size_t motion) const { return moves_on_[motion]; }

 private:
  std::vector<std::vector<std::size_t>> before_;
  std::vector<bool> stands_;
  std::vector<bool> moves_on_;
};

}  // namespace armloom
