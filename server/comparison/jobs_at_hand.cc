#include "server/comparison/jobs_at_hand.h"

#include <utility>

namespace armloom {

void JobsAtHand::note(Job job) {
  bytes_ += job.body->size();
  jobs_.push_back(std::move(job));
  while (jobs_.size() > bounds_.jobs || bytes_ > bounds_.bytes) {
    bytes_ -= jobs_.front().body->size();
    jobs_.pop_front();
    some_are_gone_ = true;
  }
}

JobsAtHand::Taken JobsAtHand::since(std::optional<TimePoint> from) const {
  Taken taken{{}, !some_are_gone_};
  for (const Job& job : jobs_) {
    if (from && job.submitted_at < *from) {
      taken.whole = false;
    } else {
      taken.jobs.push_back(job);
    }
  }
  return taken;
}

}  // namespace armloom
