#include "core/executive/run_count.h"

#include <algorithm>
#include <limits>

namespace armloom {

RunCount::RunCount(std::size_t arms) {
  figures_.busy.assign(arms, Duration{});
  figures_.min_clearance_m = figures_.between_arms_m = std::numeric_limits<double>::infinity();
}

void RunCount::end_of_a_job(TimePoint at) { figures_.last_end = std::max(figures_.last_end, at); }

void RunCount::motion(const Motions& motions) {
  std::size_t in_motion = 0;
  for (std::uint32_t arm = 0; arm < figures_.busy.size(); ++arm) {
    if (!motions.advances(ArmId{arm})) continue;
    figures_.busy[arm] += kControlPeriod;
    ++in_motion;
  }
  if (in_motion >= 2) figures_.together += kControlPeriod;
}

void RunCount::look(const std::vector<Proximity>& near) {
  for (const Proximity& pair : near) {
    figures_.min_clearance_m = std::min(figures_.min_clearance_m, pair.clearance_m);
    if (!pair.arm_b) continue;
    figures_.between_arms_m = std::min(figures_.between_arms_m, pair.clearance_m);
  }
}

}  // namespace armloom
