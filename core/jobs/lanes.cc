#include "core/jobs/lanes.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace armloom {
namespace {

// Returns true if the path to a waiting goal may change: by its plan, a new plan or a detour.
bool is_way_open(const Step& step) { return step.goal && step.in<Queued>() != nullptr; }

WaitingLeg waiting_leg(const Step& step) {
  WaitingLeg leg = step.leg;
  for (JobId before : step.job->after) leg.after.push_back(only_step(before));
  leg.is_estimate = is_way_open(step);
  leg.is_approached = step.is_brought_to_start();
  return leg;
}

// Returns true if the step comes after a waiting step of other arms for which `is_leg` is false.
bool comes_after_unknown(const Step& step, const JobBook& book,
                         const std::function<bool(JobId)>& is_leg) {
  return std::ranges::any_of(step.job->after, [&](JobId id) {
    const Step* before = book.find(id);
    return before != nullptr && before->in<Queued>() != nullptr && !is_leg(id) &&
           before->leg.arms != step.leg.arms;
  });
}

}  // namespace

void Lanes::add(const Step& step, const JobBook& book) {
  if (step.job->errand.before) is_stale_ = true;
  if (is_stale_ || !step.knows_its_end() || is_left_out(step)) return;
  if (comes_after_unknown(step, book, [&](JobId id) { return sequence_.has(only_step(id)); })) {
    left_out_.insert(step.leg.arms.begin(), step.leg.arms.end());
  } else {
    sequence_.append(waiting_leg(step));
  }
}

bool Lanes::is_left_out(const Step& step) const {
  return std::ranges::any_of(step.leg.arms, [&](ArmId arm) { return left_out_.contains(arm); });
}

void Lanes::follow(const Step& step, const StepPhase& before) {
  const bool waited = std::holds_alternative<Queued>(before);
  const auto* ended = step.in<Ended>();
  if (waited && !left_out_.empty()) is_stale_ = true;  // steps that come after it may have a place
  if (waited && ended != nullptr) {
    if (!sequence_.remove(step.id)) is_stale_ = true;
  } else if (!waited && (step.in<Queued>() != nullptr ||
                         (ended != nullptr && ended->state != JobState::succeeded))) {
    is_stale_ = true;
  }
}

void Lanes::renew(const JobBook& book, const ArmRests& arms) {
  if (!std::exchange(is_stale_, false)) return;
  std::vector<PlacePtr> stands = arms.places();
  std::set<JobId> waiting;
  for (std::uint32_t arm = 0; arm < stands.size(); ++arm) {
    for (StepId which : book.queues()[ArmId{arm}]) {
      const Step& step = book.at(which);
      if (step.in<Queued>() != nullptr) {
        if (step.knows_its_end()) waiting.insert(which.job);
        continue;
      }
      for (std::size_t i = 0; i < step.leg.arms.size(); ++i) {
        if (step.leg.arms[i].index() == arm) stands[arm] = step.leg.to[i];
      }
    }
  }
  left_out_.clear();
  std::set<JobId> placed;
  std::vector<WaitingLeg> legs;
  for (JobId id : in_turn(book, waiting)) {
    const Step& step = book.at(id);
    const auto is_leg = [&](JobId before) { return placed.contains(before); };
    if (is_left_out(step) || comes_after_unknown(step, book, is_leg)) {
      left_out_.insert(step.leg.arms.begin(), step.leg.arms.end());
      continue;
    }
    placed.insert(id);
    WaitingLeg& leg = legs.emplace_back(waiting_leg(step));
    if (step.job->errand.lets_pass && book.active().contains(*step.job->errand.lets_pass)) {
      leg.after.push_back(only_step(*step.job->errand.lets_pass));
    }
  }
  sequence_.renew(std::move(stands), legs);
}

SafeSequence::Outlook Lanes::after(const std::vector<StepId>& steps, const JobBook& book,
                                   const ArmRests& arms) {
  const auto in_queue = [&](StepId step) { return book.at(step).in<Queued>() != nullptr; };
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
    const Step* leg = book.find(passage.leg);
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
  const bool rests = queue.empty() || book.at(queue.front()).in<Queued>() != nullptr;
  if (!rests || is_stale_) return;
  sequence_.learn({step, arms.place(arm), book.at(step).leg.motion}, false,
                  std::make_shared<const PassageBlock>(block));
}

}  // namespace armloom
