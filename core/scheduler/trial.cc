#include "core/scheduler/trial.h"

#include <algorithm>
#include <utility>

#include "core/scheduler/waiting/waits.h"

namespace armloom {

Trial::Trial(Scheduler scheduler, std::optional<Question> open, const std::vector<Submit>& jobs,
             JobId asked, TimePoint now)
    : scheduler_(std::move(scheduler)), job_(asked), now_(now), open_(std::move(open)) {
  for (const Submit& job : jobs) step(job);
}

void Trial::step(const Input& input) {
  for (Effect& effect : scheduler_.step(input, now_)) {
    if (auto* judge = std::get_if<Judge>(&effect)) open_ = std::move(judge->question);
  }
  const Job* job = scheduler_.find(job_);
  if (job != nullptr && !job->waits_on.empty()) waits_ = job->waits_on;
}

bool Trial::is_decided() const {
  const JobState state = scheduler_.find(job_)->state();
  return (state != JobState::queued && state != JobState::backlogged) ||
         judgements_ >= kJudgementsMax;
}

std::optional<Question> Trial::next() const { return is_decided() ? std::nullopt : open_; }

void Trial::answer(Verdict verdict) {
  const Question question = std::move(*open_);
  open_.reset();
  ++judgements_;
  // Not where an arm is asked about that would have gone aside.
  const bool as_arms_stand = question.rest == scheduler_.rest();
  const bool of_it =
      std::ranges::find(question.candidates, job_, &Motion::job) != question.candidates.end();
  if (of_it && as_arms_stand) {
    evaluations_ += verdict.evaluations;
    by_clock_ = scheduler_.earliest_start(question, verdict);
    last_ = verdict;
    last_->regions.clear();
  }
  step(Judged{std::move(verdict)});
}

Trial::Outcome Trial::outcome() const {
  const Job& job = *scheduler_.find(job_);
  Outcome outcome{.kind = Verdict::Kind::conflict, .evaluations = evaluations_};
  if (job.has_authority()) {
    outcome.kind = Verdict::Kind::free;
    outcome.starts_in = std::max(Duration{}, *job.times.scheduled_at - now_);
    outcome.waits = job.waits_on;
    if (last_) outcome.clearance_bound = last_->clearance_bound;
    return outcome;
  }
  outcome.starts_in = by_clock_;
  outcome.waits = waits_;
  if (job.has_ended() && last_) {
    outcome.waits.clear();
    for (const Conflict& conflict : last_->conflicts) outcome.waits.push_back(wait_for(conflict));
  }
  if (last_ && last_->kind == Verdict::Kind::undecided) outcome.kind = Verdict::Kind::undecided;
  return outcome;
}

}  // namespace armloom
