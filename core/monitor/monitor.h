#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/time.h"
#include "core/coordination/proximity.h"

namespace armloom {

// What the monitor found and whom it stops.
struct MonitorFinding {
  enum class Kind { contact, clearance };
  Kind kind;
  TimePoint time;
  Proximity proximity;       // which links, how close
  double limit_m;            // what it should have been: Proximity::limit_m, of this pair
  std::vector<ArmId> stops;  // arms to stop: those of the pair that move
};
[[nodiscard]] constexpr const char* to_string(MonitorFinding::Kind kind) {
  switch (kind) {
    case MonitorFinding::Kind::contact:
      return "contact";
    case MonitorFinding::Kind::clearance:
      return "clearance";
  }
  return nullptr;
}

// Watches the joined measured state: all arms as one state, against itself and the scene. Pure: it
// is handed the pairs that are too close and says what they mean.
class Monitor {
 public:
  // `too_close`: every pair below its own limit_m in the measured state at `now`; `moving`:
  // indexed by ArmId. A pair is found once: while it stays below the limit it is found again only
  // if one of its arms moves and it has come closer by more than kCloserBy_m since (so that
  // arms may be moved apart after a stop). A pair of which no arm moves is found without stops.
  inline static constexpr double kCloserBy_m = 0.0005;
  [[nodiscard]] std::vector<MonitorFinding> observe(const std::vector<Proximity>& too_close,
                                                    const std::vector<bool>& moving, TimePoint now);

 private:
  std::map<std::pair<std::string, std::string>, double> known_;  // pair -> closest so far
};

}  // namespace armloom
