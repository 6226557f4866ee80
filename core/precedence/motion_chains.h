#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/precedence/coordinated_motion.h"

namespace armloom {

// In this file, a motion is an index into a list in which the motions of one arm are in running
// order.

// Returns the arm's motion before this one; nullopt: none.
[[nodiscard]] std::optional<std::size_t> motion_before(
    const std::vector<CoordinatedMotion>& motions, std::size_t motion, ArmId arm);

// The motions before each motion of a list.
class MotionChains {
 public:
  explicit MotionChains(const std::vector<CoordinatedMotion>& motions);

  // Returns motion_before() for each arm that has one.
  [[nodiscard]] const std::vector<std::size_t>& before(std::size_t motion) const {
    return before_[motion];
  }

 private:
  std::vector<std::vector<std::size_t>> before_;
};

// Returns those of `arms` that the motion `other` finds where they rest after the motion `from`,
// because their next motion does not exist, or must wait for `other` on an arm that both move.
[[nodiscard]] std::vector<ArmId> resting_for(const std::vector<CoordinatedMotion>& motions,
                                             const std::vector<ArmId>& arms, std::size_t from,
                                             std::size_t other);

}  // namespace armloom
