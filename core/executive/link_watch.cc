#include "core/executive/link_watch.h"

#include <utility>

namespace armloom {

std::vector<LinkWatch::Change> LinkWatch::look(const Motions& motions) {
  using Kind = Change::Kind;
  std::vector<Change> changes;
  for (std::uint32_t a = 0; a < seen_.size(); ++a) {
    const ArmLink& link = motions.link(ArmId{a});
    const bool is_up = link.state() == ArmLink::State::up || link.state() == ArmLink::State::stale;
    const Seen now = is_up                                        ? Seen::up
                     : link.state() == ArmLink::State::connecting ? Seen::waiting
                                                                  : Seen::lost;
    const Seen before = std::exchange(seen_[a], now);
    if (before == now) continue;
    if (now == Seen::waiting) changes.push_back({ArmId{a}, Kind::waits, link.detail()});
    if (now == Seen::lost) changes.push_back({ArmId{a}, Kind::lost, link.detail()});
    if (now == Seen::up && before == Seen::waiting)
      changes.push_back({ArmId{a}, Kind::connected, {}});
    if (now == Seen::up && before == Seen::lost) changes.push_back({ArmId{a}, Kind::back, {}});
  }
  return changes;
}

}  // namespace armloom
