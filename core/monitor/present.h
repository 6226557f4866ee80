#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/monitor/finding.h"

namespace armloom {

// Checks the measured state of all arms together, against each other and the scene. Pure: the
// caller finds the pairs that are too close.
class PresentCheck {
 public:
  // Returns the new findings. `too_close`: every pair whose distance is below its limit_m in the
  // measured state at `now`; `moving`: by ArmId. A pair is reported when it falls below its limit,
  // unless none of its arms moves and it was above the limit for less than kSameCondition. While it
  // stays below, it is reported again only if one of its arms moves and the distance has shrunk by
  // more than kCloserBy_m. So arms can be moved apart after a stop. A pair without a moving arm
  // stops no arm.
  inline static constexpr double kCloserBy_m = 0.0005;
  [[nodiscard]] std::vector<MonitorFinding> observe(const std::vector<Proximity>& too_close,
                                                    const std::vector<bool>& moving, TimePoint now);

 private:
  struct Known {
    double distance_m;  // when it was reported last, or fell below its limit last if that is later
    std::optional<TimePoint> parted_at = {};  // set: it is no longer below its limit
  };
  std::map<std::pair<std::string, std::string>, Known> known_;
};

}  // namespace armloom
