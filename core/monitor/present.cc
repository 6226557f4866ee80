#include "core/monitor/present.h"

#include <algorithm>
#include <optional>

namespace armloom {
namespace {

using Pair = std::pair<std::string, std::string>;

Pair key_of(const Proximity& proximity) {
  Pair key{proximity.body_a, proximity.body_b};
  // An object may bear a link's name; two links are one pair in either order.
  if (proximity.object_b) {
    key.second.insert(0, "object ");
  } else if (key.second < key.first) {
    std::swap(key.first, key.second);
  }
  return key;
}

std::vector<ArmId> moving_arms(const Proximity& proximity, const std::vector<bool>& moving) {
  std::vector<ArmId> arms;
  for (const std::optional<ArmId>& arm : {proximity.arm_a, proximity.arm_b}) {
    if (!arm || !moving.at(arm->index())) continue;
    if (std::find(arms.begin(), arms.end(), *arm) == arms.end()) arms.push_back(*arm);
  }
  return arms;
}

}  // namespace

std::vector<MonitorFinding> PresentCheck::observe(const std::vector<Proximity>& too_close,
                                                  const std::vector<bool>& moving, TimePoint now) {
  std::vector<MonitorFinding> findings;
  std::map<Pair, double> still_known;  // what is no longer too close is forgotten
  for (const Proximity& proximity : too_close) {
    Pair key = key_of(proximity);
    std::vector<ArmId> stops = moving_arms(proximity, moving);
    const auto before = known_.find(key);
    const bool found_before = before != known_.end();
    const bool closer =
        found_before && !stops.empty() && proximity.clearance_m < before->second - kCloserBy_m;
    if (found_before && !closer) {
      still_known.emplace(std::move(key), before->second);
      continue;
    }
    if (!still_known.emplace(std::move(key), proximity.clearance_m).second) continue;
    findings.push_back({.kind = proximity.clearance_m <= 0.0 ? MonitorFinding::Kind::contact
                                                             : MonitorFinding::Kind::clearance,
                        .time = now,
                        .proximity = proximity,
                        .limit_m = proximity.limit_m,
                        .stops = std::move(stops)});
  }
  known_ = std::move(still_known);
  return findings;
}

}  // namespace armloom
