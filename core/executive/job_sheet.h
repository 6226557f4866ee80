#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/executive/events.h"

namespace armloom {

// The jobs as clients see them, in order of ids. An immutable value: a copy copies only one
// pointer, however many jobs there are.
class JobSheet {
 public:
  using JobPtr = std::shared_ptr<const JobView>;

  // Null if no job has this id.
  [[nodiscard]] JobPtr find(JobId job) const;
  // Calls each(job) in order of ids.
  template <class Each>
  void each(Each each) const {
    for (const Slot& slot : *slots_) {
      for (const JobPtr& job : slot.page->jobs) {
        if (job) each(job);
      }
    }
  }
  // Calls take(job) for the newest job first, until it returns false.
  template <class Take>
  void newest_first(Take take) const {
    for (auto slot = slots_->rbegin(); slot != slots_->rend(); ++slot) {
      for (auto job = slot->page->jobs.rbegin(); job != slot->page->jobs.rend(); ++job) {
        if (*job && !take(*job)) return;
      }
    }
  }

 private:
  friend class JobLedger;
  inline static constexpr std::size_t kPage = 128;
  struct Page {
    std::array<JobPtr, kPage> jobs = {};  // at id % kPage
    std::size_t count = 0;
    std::uint64_t edition = 0;  // JobLedger
  };
  struct Slot {
    std::uint64_t number;  // id / kPage
    std::shared_ptr<Page> page;
  };
  using Slots = std::vector<Slot>;
  static const Slot* find(const Slots& slots, std::uint64_t number);

  std::shared_ptr<const Slots> slots_ = std::make_shared<const Slots>();
};

// The strand's own copy of the jobs, which can change. A change copies at most one page of jobs.
// Sheets that were shared before stay unchanged, and share all other pages.
class JobLedger {
 public:
  void put(JobSheet::JobPtr job);  // replaces the job with its id
  void erase(JobId job);
  [[nodiscard]] JobSheet share();

 private:
  JobSheet::Page& own_page(std::uint64_t number);

  JobSheet::Slots slots_;      // by number
  std::uint64_t edition_ = 1;  // pages with this number are in no sheet yet
  JobSheet shared_;
  bool is_shared_ = true;
};

}  // namespace armloom
