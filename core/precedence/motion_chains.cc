#include "core/precedence/motion_chains.h"

#include <algorithm>
#include <iterator>

namespace armloom {

std::optional<std::size_t> motion_before(const std::vector<CoordinatedMotion>& motions,
                                         std::size_t motion, ArmId arm) {
  while (motion > 0) {
    if (motions[--motion].moves(arm)) return motion;
  }
  return std::nullopt;
}

MotionChains::MotionChains(const std::vector<CoordinatedMotion>& motions)
    : before_(motions.size()) {
  for (std::size_t m = 0; m < motions.size(); ++m) {
    for (const ArmId arm : motions[m].arms) {
      if (const auto ahead = motion_before(motions, m, arm)) before_[m].push_back(*ahead);
    }
  }
}

std::vector<ArmId> resting_for(const std::vector<CoordinatedMotion>& motions,
                               const std::vector<ArmId>& arms, std::size_t from,
                               std::size_t other) {
  std::vector<ArmId> resting;
  std::ranges::copy_if(arms, std::back_inserter(resting), [&](ArmId arm) {
    std::size_t next = from + 1;
    while (next < motions.size() && !motions[next].moves(arm)) ++next;
    if (next == motions.size()) return true;
    return next > other && share_an_arm(motions[next], motions[other]);
  });
  return resting;
}

}  // namespace armloom
