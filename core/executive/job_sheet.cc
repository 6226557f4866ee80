#include "core/executive/job_sheet.h"

#include <algorithm>
#include <utility>

namespace armloom {

const JobSheet::Slot* JobSheet::find(const Slots& slots, std::uint64_t number) {
  const auto slot = std::ranges::lower_bound(slots, number, {}, &Slot::number);
  return slot == slots.end() || slot->number != number ? nullptr : &*slot;
}

JobSheet::JobPtr JobSheet::find(JobId job) const {
  const Slot* slot = find(*slots_, job.value() / kPage);
  return slot == nullptr ? nullptr : slot->page->jobs[job.value() % kPage];
}

JobSheet::Page& JobLedger::own_page(std::uint64_t number) {
  is_shared_ = false;
  auto slot = std::ranges::lower_bound(slots_, number, {}, &JobSheet::Slot::number);
  if (slot == slots_.end() || slot->number != number) {
    slot = slots_.insert(slot, {number, std::make_shared<JobSheet::Page>()});
  } else if (slot->page->edition != edition_) {
    slot->page = std::make_shared<JobSheet::Page>(*slot->page);
  }
  slot->page->edition = edition_;
  return *slot->page;
}

void JobLedger::put(JobSheet::JobPtr job) {
  const std::uint64_t id = job->id.value();
  JobSheet::Page& page = own_page(id / JobSheet::kPage);
  JobSheet::JobPtr& place = page.jobs[id % JobSheet::kPage];
  if (!place) ++page.count;
  place = std::move(job);
}

void JobLedger::erase(JobId job) {
  const std::uint64_t number = job.value() / JobSheet::kPage;
  const JobSheet::Slot* slot = JobSheet::find(slots_, number);
  if (slot == nullptr || !slot->page->jobs[job.value() % JobSheet::kPage]) return;
  JobSheet::Page& page = own_page(number);
  page.jobs[job.value() % JobSheet::kPage].reset();
  if (--page.count > 0) return;
  std::erase_if(slots_, [&](const JobSheet::Slot& one) { return one.number == number; });
}

JobSheet JobLedger::share() {
  if (is_shared_) return shared_;
  is_shared_ = true;
  ++edition_;
  shared_.slots_ = std::make_shared<const JobSheet::Slots>(slots_);
  return shared_;
}

}  // namespace armloom
