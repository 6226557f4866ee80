#include "core/monitor/stop_set.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <set>

namespace armloom {
namespace {

using Group = std::vector<const StopConflict*>;

std::vector<ArmId> arms_of(const Group& group) {
  std::set<ArmId> arms;
  for (const StopConflict* conflict : group) {
    arms.insert(conflict->a);
    if (conflict->b) arms.insert(*conflict->b);
  }
  return {arms.begin(), arms.end()};
}

// Returns the conflicts in groups that share no arm.
std::vector<Group> groups_of(const std::vector<StopConflict>& conflicts) {
  std::map<ArmId, ArmId> leader;  // smallest known arm of the group
  const auto find = [&](ArmId arm) {
    leader.try_emplace(arm, arm);
    while (leader.at(arm) != arm) arm = leader.at(arm);
    return arm;
  };
  for (const StopConflict& conflict : conflicts) {
    const auto [first, last] = std::minmax(find(conflict.a), find(conflict.b.value_or(conflict.a)));
    leader.at(last) = first;
  }
  std::map<ArmId, Group> groups;
  for (const StopConflict& conflict : conflicts) groups[find(conflict.a)].push_back(&conflict);
  std::vector<Group> all;
  for (auto& [arm, group] : groups) all.push_back(std::move(group));
  return all;
}

bool resolves(const Group& group, const std::set<ArmId>& stops) {
  return std::ranges::all_of(group, [&](const StopConflict* conflict) {
    return conflict->is_resolved_by(stops.contains(conflict->a),
                                    conflict->b && stops.contains(*conflict->b));
  });
}

std::set<ArmId> exact(const Group& group, const std::vector<ArmId>& arms) {
  struct Bits {
    std::uint32_t a, b;
    const StopConflict* conflict;
  };
  const auto bit = [&](ArmId arm) { return 1U << (std::ranges::find(arms, arm) - arms.begin()); };
  std::vector<Bits> all;
  for (const StopConflict* conflict : group) {
    all.push_back({bit(conflict->a), conflict->b ? bit(*conflict->b) : 0U, conflict});
  }
  std::uint32_t best = (1U << arms.size()) - 1U;  // resolves everything
  for (std::uint32_t stops = 1; stops < (1U << arms.size()); ++stops) {
    const int more = std::popcount(stops) - std::popcount(best);
    const std::uint32_t differing = stops ^ best;
    const bool is_first = (differing & (~differing + 1U) & stops) != 0;
    if (more > 0 || (more == 0 && !is_first)) continue;
    const bool resolves_all = std::ranges::all_of(all, [stops](const Bits& of) {
      return of.conflict->is_resolved_by((stops & of.a) != 0, (stops & of.b) != 0);
    });
    if (resolves_all) best = stops;
  }
  std::set<ArmId> stopped;
  for (const ArmId arm : arms) {
    if ((best & bit(arm)) != 0) stopped.insert(arm);
  }
  return stopped;
}

std::set<ArmId> greedy(const Group& group) {
  std::set<ArmId> stops;
  while (!resolves(group, stops)) {
    std::map<ArmId, int> open;  // number of unresolved conflicts by arm
    for (const StopConflict* conflict : group) {
      const bool b_stops = conflict->b && stops.contains(*conflict->b);
      if (conflict->is_resolved_by(stops.contains(conflict->a), b_stops)) continue;
      if (!stops.contains(conflict->a)) ++open[conflict->a];
      if (conflict->b && !b_stops) ++open[*conflict->b];
    }
    const auto most =
        std::ranges::max_element(open, {}, [](const auto& arm) { return arm.second; });
    stops.insert(most->first);
  }
  return stops;
}

}  // namespace

std::vector<ArmId> smallest_stop_set(const std::vector<StopConflict>& conflicts) {
  std::set<ArmId> all;
  for (const Group& group : groups_of(conflicts)) {
    const std::vector<ArmId> arms = arms_of(group);
    all.merge(arms.size() <= kExactArms ? exact(group, arms) : greedy(group));
  }
  return {all.begin(), all.end()};
}

}  // namespace armloom
