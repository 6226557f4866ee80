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
  std::map<Pair, Known> known;
  for (const Proximity& proximity : too_close) {
    Pair key = key_of(proximity);
    std::vector<ArmId> stops = moving_arms(proximity, moving);
    const auto before = known_.find(key);
    const bool is_known = before != known_.end();
    const bool stays = is_known && !before->second.parted_at;
    const bool closer =
        stays && !stops.empty() && proximity.clearance_m < before->second.distance_m - kCloserBy_m;
    const bool keeps_distance = stays && !closer;
    const double distance_m = keeps_distance ? before->second.distance_m : proximity.clearance_m;
    if (!known.try_emplace(std::move(key), Known{distance_m}).second) continue;
    if (keeps_distance || (is_known && stops.empty())) continue;
    findings.push_back({.kind = proximity.clearance_m <= 0.0 ? MonitorFinding::Kind::contact
                                                             : MonitorFinding::Kind::clearance,
                        .time = now,
                        .proximity = proximity,
                        .limit_m = proximity.limit_m,
                        .stops = std::move(stops)});
  }
  for (auto& [pair, parted] : known_) {
    if (!parted.parted_at) parted.parted_at = now;
    if (now - *parted.parted_at < kSameCondition) known.try_emplace(pair, parted);
  }
  known_ = std::move(known);
  return findings;
}

}  // namespace armloom
