#include "core/sequence/safe_sequence.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace armloom {
// ---- Legs ----

SafeSequence::SafeSequence(const SafeSequence& other)
    : tolerance_(other.tolerance_),
      stands_(other.stands_),
      ends_(other.ends_),
      sequence_(other.sequence_),
      unplaced_(other.unplaced_),
      unplaced_legs_(other.unplaced_legs_),
      apart_(other.apart_),
      newest_(other.newest_),
      tried_(other.tried_),
      asked_(other.asked_) {
  for (Legs* legs : {&sequence_, &unplaced_}) {
    for (auto leg = legs->begin(); leg != legs->end(); ++leg) index_.emplace(leg->step, leg);
  }
  for (const Leg* leg : other.found_) found_.push_back(&*index_.at(leg->step));
}

void SafeSequence::move(State& state, const WaitingLeg& leg) {
  for (std::size_t i = 0; i < leg.arms.size(); ++i) state[leg.arms[i].index()] = leg.to[i];
}

// Returns true if all legs before it on its arms, and all that it comes after, are in the sequence.
bool SafeSequence::follows(const Leg& leg) const {
  return !leg.cut && std::ranges::all_of(leg.arms, [&](ArmId arm) {
    return unplaced_legs_[arm.index()] == 0;
  }) && std::ranges::all_of(leg.after, [&](StepId before) {
    const auto known = index_.find(before);
    return known == index_.end() || known->second->placed;
  });
}

void SafeSequence::append(WaitingLeg waiting) {
  const StepId step = waiting.step;
  const State past = waiting.is_estimate || waiting.is_approached ? ends_ : State{};
  add(std::move(waiting));
  assume(*index_.at(step), past);
}

// Assumes that paths that are not planned yet pass these places.
void SafeSequence::assume(Leg& leg, const State& past) {
  if (!leg.is_estimate && leg.approaches.empty()) return;
  for (const PlacePtr& place : past) {
    if (std::ranges::find(leg.arms, place->arm) != leg.arms.end()) continue;
    if (leg.is_estimate) leg.free[place->id] = {.free = true};
    for (Approach& approach : leg.approaches) approach.free[place->id] = {.free = true};
  }
}

void SafeSequence::add(WaitingLeg waiting) {
  Leg leg{std::move(waiting)};
  for (std::size_t i = 0; i < leg.arms.size(); ++i) {
    PlacePtr& end = ends_[leg.arms[i].index()];
    if (leg.is_estimate) leg.from[i] = end;
    const bool near =
        leg.from[i] == end || (leg.from[i]->q - end->q).cwiseAbs().maxCoeff() <= tolerance_;
    if (!near && leg.is_approached) leg.approaches.push_back({end});
    leg.cut = leg.cut || (!near && !leg.is_approached);
    end = leg.to[i];
  }
  leg.placed = follows(leg);
  for (ArmId arm : leg.arms) unplaced_legs_[arm.index()] += leg.placed ? 0 : 1;
  Legs& legs = leg.placed ? sequence_ : unplaced_;
  if ((leg.placed ? sequence_.size() : index_.size()) <= kSearched) {
    newest_ = std::max(newest_, leg.step.job);
  }
  const StepId step = leg.step;
  legs.push_back(std::move(leg));
  index_.insert_or_assign(step, std::prev(legs.end()));
  tried_ = false;
}

bool SafeSequence::remove(StepId step) {
  const auto known = index_.find(step);
  if (known == index_.end()) return true;
  const auto leg = known->second;
  const bool stays = leg->from == leg->to && !leg->cut && leg->approaches.empty();
  if (!leg->placed) {
    for (ArmId arm : leg->arms) --unplaced_legs_[arm.index()];
  }
  (leg->placed ? sequence_ : unplaced_).erase(leg);
  index_.erase(known);
  asked_.clear();
  found_.clear();
  tried_ = false;
  return stays;
}

void SafeSequence::admitted(const std::vector<StepId>& group) {
  const Order order = group == asked_ ? std::exchange(found_, {}) : Order{};
  put_in_order(order);
  for (StepId step : group) {
    const auto known = index_.find(step);
    if (known == index_.end()) continue;
    move(stands_, *known->second);
    (void)remove(step);
  }
}

void SafeSequence::renew(std::vector<PlacePtr> stands, const std::vector<WaitingLeg>& legs) {
  Legs old = std::move(sequence_);
  old.splice(old.end(), unplaced_);
  const std::unordered_map<StepId, Legs::iterator> known = std::exchange(index_, {});
  const std::size_t arms = stands.size();
  apart_.resize(arms, std::vector<bool>(arms, false));
  unplaced_legs_.assign(arms, 0);
  ends_ = stands_ = std::move(stands);
  asked_.clear();
  found_.clear();
  std::unordered_map<StepId, State> past;  // of legs with a path to be planned
  State in_turn = stands_;
  for (const WaitingLeg& leg : legs) {
    if (leg.is_estimate || leg.is_approached) past.emplace(leg.step, in_turn);
    move(in_turn, leg);
  }
  // Keeps the old order. A new leg comes before the first old leg that follows it.
  std::unordered_map<StepId, const WaitingLeg*> given;
  for (const WaitingLeg& leg : legs) given.emplace(leg.step, &leg);
  std::vector<const WaitingLeg*> order;
  std::vector<std::vector<const WaitingLeg*>> to_come(arms);  // by arm, the last one first
  for (auto leg = legs.rbegin(); leg != legs.rend(); ++leg) {
    for (ArmId arm : leg->arms) to_come[arm.index()].push_back(&*leg);
  }
  const auto take = [&](const WaitingLeg& until, const auto& again) -> void {
    for (ArmId arm : until.arms) {
      auto& lane = to_come[arm.index()];
      while (!lane.empty() && lane.back()->step != until.step) again(*lane.back(), again);
    }
    if (given.erase(until.step) == 0) return;
    order.push_back(&until);
    for (ArmId arm : until.arms) to_come[arm.index()].pop_back();
  };
  for (const Leg& leg : old) {
    const auto still = given.find(leg.step);
    if (still != given.end()) take(*still->second, take);
  }
  for (const WaitingLeg& leg : legs) {
    if (given.contains(leg.step)) take(leg, take);
  }
  std::set<StepId> to_be_added;
  for (const WaitingLeg* leg : order) to_be_added.insert(leg->step);
  for (const WaitingLeg* leg : order) {
    add(*leg);
    to_be_added.erase(leg->step);
    Leg& added = *index_.at(leg->step);
    const auto before = known.find(leg->step);
    const bool is_same = before != known.end() && before->second->arms == added.arms &&
                         before->second->motion == added.motion;
    if (is_same) added.free = std::move(before->second->free);
    for (Approach& approach : added.approaches) {
      if (!is_same) break;
      for (Approach& was : before->second->approaches)
        if (was.from == approach.from) approach.free = std::move(was.free);
    }
    if (const auto others = past.find(leg->step); others != past.end())
      assume(added, others->second);
    const bool too_early =
        std::ranges::any_of(leg->after, [&](StepId step) { return to_be_added.contains(step); });
    if (too_early && added.placed) take_out(added);
  }
}

bool SafeSequence::follows_on(StepId step) const {
  const auto known = index_.find(step);
  return known == index_.end() || (!known->second->cut && known->second->approaches.empty());
}

bool SafeSequence::has_place(StepId step) const {
  const auto known = index_.find(step);
  return known == index_.end() || known->second->placed;
}

bool SafeSequence::goes_before(StepId first, StepId other) const {
  const auto known = index_.find(first);
  if (known == index_.end() || !known->second->placed) return false;
  const auto is_either = [&](const Leg& leg) { return leg.step == first || leg.step == other; };
  return std::ranges::find_if(sequence_, is_either)->step == first;
}

// ---- Passages ----

void SafeSequence::learn(const Passage& passage, bool free,
                         std::shared_ptr<const PassageBlock> block) {
  const auto known = index_.find(passage.leg);
  if (known == index_.end() || known->second->motion != passage.motion) return;
  Leg& leg = *known->second;
  Free* of = passage.from == nullptr ? &leg.free : nullptr;
  for (Approach& approach : leg.approaches)
    if (approach.from == passage.from) of = &approach.free;
  if (of == nullptr) return;
  Known& is = of->try_emplace(passage.place->id, Known{.free = !free}).first->second;
  if (is.free == free) return;
  is = {.free = free, .block = std::move(block)};
  leg.seen.clear();
  tried_ = false;
}

void SafeSequence::forget_passages() {
  for (auto& [step, leg] : index_) {
    leg->free.clear();
    for (Approach& approach : leg->approaches) approach.free.clear();
    leg->seen.clear();
  }
  tried_ = false;
}

SafeSequence::Passes SafeSequence::passes(Leg& leg, const State& state,
                                          std::vector<Passage>* unknown, Walk* walk) {
  if (std::ranges::equal(leg.seen, state, {}, {}, &Place::id)) return Passes::free;
  bool known = true;
  const auto is_blocked = [&](const Free& free, const PlacePtr& place, const PlacePtr& from) {
    const auto found = free.find(place->id);
    if (found != free.end()) {
      if (found->second.free) return false;
      if (walk != nullptr) {
        walk->in_the_way = place;
        walk->block = found->second.block;
      }
      return true;
    }
    known = false;
    if (unknown != nullptr) unknown->push_back({leg.step, place, leg.motion, from});
    return false;
  };
  for (std::size_t arm = 0; arm < state.size(); ++arm) {
    const bool own = std::ranges::find(leg.arms, state[arm]->arm) != leg.arms.end();
    if (own || std::ranges::all_of(leg.arms, [&](ArmId a) { return apart_[a.index()][arm]; })) {
      continue;
    }
    if (is_blocked(leg.free, state[arm], nullptr)) return Passes::blocked;
    for (const Approach& approach : leg.approaches)
      if (is_blocked(approach.free, state[arm], approach.from)) return Passes::blocked;
  }
  if (!known) return Passes::unknown;
  leg.seen.clear();
  for (const PlacePtr& place : state) leg.seen.push_back(place->id);
  return Passes::free;
}

SafeSequence::Walk SafeSequence::walk(State state, std::span<Leg* const> order) {
  Walk walk;
  for (Leg* leg : order) {
    if (passes(*leg, state, &walk.unknown, &walk) == Passes::blocked) {
      walk.blocked = leg;
      break;
    }
    if (walk.unknown.size() >= kUnknownMax) break;
    move(state, *leg);
  }
  return walk;
}

}  // namespace armloom
