#pragma once

#include <cstddef>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/precedence/coordinated_motion.h"

namespace armloom {

// Which motions follow each other on the arms that they share. Of one arm they do so in the order
// of the list. Indices into it.
class MotionChains {
 public:
  explicit MotionChains(const std::vector<CoordinatedMotion>& motions);

  // The motions right before it on its arms, each once.
  [[nodiscard]] const std::vector<std::size_t>& before(std::size_t motion) const {
    return before_[motion];
  }
  // Some arm of it is at its start now.
  [[nodiscard]] bool stands(std::size_t motion) const { return stands_[motion]; }
  // Each of its arms moves on from its goal.
  [[nodiscard]] bool moves_on(std::size_t motion) const { return moves_on_[motion]; }

 private:
  std::vector<std::vector<std::size_t>> before_;
  std::vector<bool> stands_;
  std::vector<bool> moves_on_;
};

}  // namespace armloom
