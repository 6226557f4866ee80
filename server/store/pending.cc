#include "server/store/pending.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace armloom {

void Pending::join(Pending later) {
  for (auto& [number, change] : later.jobs) {
    JobChange& mine = jobs[number];
    if (change.seen) mine.seen = std::move(change.seen);
    if (change.body) mine.body = std::move(change.body);
    if (change.origin) mine.origin = std::move(change.origin);
    if (change.amended) mine.amended = std::move(change.amended);
    mine.may_have_moved = mine.may_have_moved || change.may_have_moved;
  }
  if (later.stopped_arms) stopped_arms = std::move(later.stopped_arms);
  for (AuditEntry& entry : later.audit) {
    if (audit.size() < kAuditMax) audit.push_back(std::move(entry));
  }
  for (StoredAlert& alert : later.alerts) {
    if (alerts.size() < kAlertsMax) alerts.push_back(std::move(alert));
  }
  std::ranges::move(later.acceptances, std::back_inserter(acceptances));
  std::ranges::move(later.starts, std::back_inserter(starts));
}

std::vector<Pending::Done> Pending::give_up_acceptances() {
  std::vector<Done> callers;
  for (Acceptance& acceptance : std::exchange(acceptances, {})) {
    for (std::uint64_t number : acceptance.jobs) jobs.erase(number);
    callers.push_back(std::move(acceptance.done));
  }
  return callers;
}

}  // namespace armloom
