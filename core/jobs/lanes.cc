#include "core/jobs/lanes.h"

#include <algorithm>
#include <utility>

namespace armloom {
namespace {

// While a goal waits its way may yet be another one: it is planned for the first time, anew, or
// around what others hold.
bool is_way_open(const Job& job) { return job.goal && job.in<Queued>() != nullptr; }

WaitingLeg waiting_leg(const Record& record) {
  WaitingLeg leg = record.leg;
  for (JobId before : record.job.after) leg.after.push_back(only_step(before));
  leg.is_estimate = is_way_open(record.job);
  leg.is_approached = record.is_brought_to_start();
  return leg;
}

}  // namespace

void Lanes::add(const Record& record) {
  if (record.errand.before) is_stale_ = true;
  if (is_stale_ || !record.job.knows_its_end()) return;
  sequence_.append(waiting_leg(record));
}

void Lanes::follow(const Job& job, const JobPhase& before) {
  const bool waited = std::holds_alternative<Queued>(before);
  const auto* ended = job.in<Ended>();
  if (waited && ended != nullptr) {
    if (!sequence_.remove(job.step())) is_stale_ = true;
  } else if (!waited && (job.in<Queued>() != nullptr ||
                         (ended != nullptr && ended->state != JobState::succeeded))) {
    is_stale_ = true;
  }
}

void Lanes::renew(const JobBook& book, const ArmRests& arms) {
  if (!std::exchange(is_stale_, false)) return;
  std::vector<PlacePtr> stands = arms.places();
  std::set<JobId> waiting;
  for (std::uint32_t arm = 0; arm < stands.size(); ++arm) {
    for (StepId step : book.queues()[ArmId{arm}]) {
      const Record& record = book.at(step);
      if (record.job.in<Queued>() != nullptr) {
        if (record.job.knows_its_end()) waiting.insert(step.job);
        continue;
      }
      for (std::size_t i = 0; i < record.leg.arms.size(); ++i) {
        if (record.leg.arms[i].index() == arm) stands[arm] = record.leg.to[i];
      }
    }
  }
  std::vector<WaitingLeg> legs;
  for (JobId id : in_turn(book, waiting)) {
    const Record& record = book.at(id);
    WaitingLeg& leg = legs.emplace_back(waiting_leg(record));
    if (record.errand.lets_pass && book.is_active(*record.errand.lets_pass)) {
      leg.after.push_back(only_step(*record.errand.lets_pass));
    }
  }
  sequence_.renew(std::move(stands), legs);
}

SafeSequence::Outlook Lanes::after(const std::vector<StepId>& steps, const JobBook& book,
                                   const ArmRests& arms) {
  const auto in_queue = [&](StepId step) { return book.at(step).job.in<Queued>() != nullptr; };
  if (!std::ranges::all_of(steps, in_queue)) return {};
  renew(book, arms);
  return sequence_.after(steps);
}

bool Lanes::has_place(StepId step, const JobBook& book, const ArmRests& arms) {
  renew(book, arms);
  (void)sequence_.after({});
  return sequence_.has_place(step);
}

void Lanes::learn(const std::vector<Passage>& asked, const Verdict& verdict, const JobBook& book) {
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const Passage& passage = asked[i];
    const PassageAnswer answer =
        verdict.passages.empty() ? PassageAnswer::free : verdict.passages[i];
    const bool has_evidence = i < verdict.passage_blocks.size() && verdict.passage_blocks[i];
    sequence_.learn(
        passage, answer != PassageAnswer::blocked,
        has_evidence ? std::make_shared<const PassageBlock>(*verdict.passage_blocks[i]) : nullptr);
    const Record* leg = book.find(passage.leg);
    if (answer != PassageAnswer::apart || leg == nullptr) continue;
    if (passage.from != nullptr) {
      sequence_.learn_apart(passage.from->arm, passage.place->arm);
    } else {
      for (ArmId arm : leg->leg.arms) sequence_.learn_apart(arm, passage.place->arm);
    }
  }
}

void Lanes::learn_in_the_way(StepId step, ArmId arm, const PassageBlock& block, const JobBook& book,
                             const ArmRests& arms) {
  const auto& queue = book.queues()[ArmId{arm}];
  const bool rests = queue.empty() || book.at(queue.front()).job.in<Queued>() != nullptr;
  if (!rests || is_stale_) return;
  sequence_.learn({step, arms.place(arm), book.at(step).leg.motion}, false,
                  std::make_shared<const PassageBlock>(block));
}

}  // namespace armloom
