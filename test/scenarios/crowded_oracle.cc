#include "test/scenarios/crowded_oracle.h"

#include <algorithm>
#include <bit>

namespace armloom {

CrowdedOracle::CrowdedOracle(const CrowdedWorkload& world)
    : world_(world), queues_(world.homes.size()) {
  for (const auto& one : world.submitted) queues_[one.motion.arm].push_back(one.motion);
}

Eigen::Vector2d CrowdedOracle::stands(std::size_t arm, std::size_t done) const {
  return done == 0 ? world_.homes[arm] : queues_[arm][done - 1].way.back();
}

bool CrowdedOracle::solvable(const std::vector<std::size_t>& done) {
  const auto known = known_.find(done);
  if (known != known_.end()) return known->second;
  bool ended = true;
  unsigned have_more = 0;
  for (std::size_t arm = 0; arm < done.size(); ++arm) {
    if (done[arm] == queues_[arm].size()) continue;
    ended = false;
    have_more |= 1U << arm;
  }
  bool found = ended;
  for (unsigned together = 1; !found && together <= have_more; ++together) {
    if ((together & ~have_more) != 0 || !free(done, together)) continue;
    std::vector<std::size_t> next = done;
    for (std::size_t arm = 0; arm < next.size(); ++arm) next[arm] += together >> arm & 1U;
    found = solvable(next);
  }
  return known_[done] = found;
}

bool CrowdedOracle::free(const std::vector<std::size_t>& done, unsigned together) {
  constexpr double kStep_s = 0.01;
  const double kept_m = std::popcount(together) > 1 ? kKeptTogether_m : kKeptOneByOne_m;
  double lasts_s = 0.0;
  std::vector<Eigen::Vector2d> at;
  for (std::size_t arm = 0; arm < done.size(); ++arm) {
    at.push_back(stands(arm, done[arm]));
    if (together >> arm & 1U) {
      lasts_s = std::max(lasts_s, queues_[arm][done[arm]].duration_s());
    }
  }
  for (double t = 0.0; t < lasts_s + kStep_s; t += kStep_s) {
    for (std::size_t arm = 0; arm < done.size(); ++arm) {
      if (together >> arm & 1U) at[arm] = queues_[arm][done[arm]].at(t);
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (((together >> i | together >> j) & 1U) == 0) continue;
        if ((at[i] - at[j]).norm() < kept_m - 1e-3) return false;
      }
    }
  }
  return true;
}

}  // namespace armloom
