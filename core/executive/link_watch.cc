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
                     : link.state() != ArmLink::State::connecting ? Seen::lost
                     : link.was_in_use()                          ? Seen::in_use
                                                                  : Seen::waiting;
    const Seen before = std::exchange(seen_[a], now);
    const bool stopped = is_up && link.stopped_by_itself();
    if (stopped && !stopped_[a] && before == Seen::up)
      changes.push_back({ArmId{a}, Kind::stopped, ""});
    stopped_[a] = stopped;
    const bool is_news = before != now || (now == Seen::waiting && details_[a] != link.detail());
    details_[a] = link.detail();
    if (!is_news || (before == Seen::nothing && now == Seen::up)) continue;
    const Kind kind = now == Seen::waiting   ? Kind::waits
                      : now == Seen::in_use  ? Kind::in_use
                      : now == Seen::lost    ? Kind::lost
                      : before == Seen::lost ? Kind::back
                                             : Kind::connected;
    changes.push_back({ArmId{a}, kind, link.detail()});
  }
  return changes;
}

}  // namespace armloom
