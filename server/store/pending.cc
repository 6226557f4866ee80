#include "server/store/pending.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace armloom {

void PendingAudit::add(AuditEntry entry) {
  const bool is_refusal = was_refused(entry);
  if ((is_refusal ? refusals_ : entries_.size() - refusals_) >= kMax) return;
  refusals_ += is_refusal ? 1 : 0;
  entries_.push_back(std::move(entry));
}

void Pending::join(Pending later) {
  for (auto& [number, change] : later.jobs) {
    JobChange& mine = jobs[number];
    if (change.seen) mine.seen = std::move(change.seen);
    if (change.body) mine.body = std::move(change.body);
    if (change.origin) mine.origin = std::move(change.origin);
    if (change.amended) mine.amended = std::move(change.amended);
    mine.may_have_moved = mine.may_have_moved || change.may_have_moved;
  }
  if (later.stops) stops = std::move(later.stops);
  for (const AuditEntry& entry : later.audit.entries()) audit.add(entry);
  for (StoredAlert& alert : later.alerts) {
    if (alerts.size() < kAlertsMax) alerts.push_back(std::move(alert));
  }
  for (auto& [name, object] : later.objects) objects.insert_or_assign(name, std::move(object));
  for (auto& [arm, speed] : later.speeds) speeds.insert_or_assign(arm, std::move(speed));
  for (Answer& answer : later.answers) {
    if (answers.size() < kAnswersMax) answers.push_back(std::move(answer));
  }
  std::ranges::move(later.acceptances, std::back_inserter(acceptances));
  std::ranges::move(later.starts, std::back_inserter(starts));
}

void GivenUpJobs::pass_over(Pending& changes) {
  if (jobs_.empty()) return;
  std::erase_if(changes.starts,
                [this](const Pending::Start& start) { return jobs_.contains(start.job); });
  std::erase_if(changes.jobs, [this](const auto& said) {
    const auto& [number, change] = said;
    const auto job = jobs_.find(number);
    if (job == jobs_.end()) return false;
    if (change.seen && change.seen->has_ended) jobs_.erase(job);
    return true;
  });
}

}  // namespace armloom
