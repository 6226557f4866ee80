// Finds what remains after an admission: the sequence, another order of its first legs, or none.
#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "core/sequence/safe_sequence.h"

namespace armloom {
namespace {

// Legs of the sequence that are looked at if a leg is admitted that is not in it.
constexpr std::size_t kFar = 256;

bool among(const std::vector<StepId>& steps, StepId step) {
  return std::ranges::find(steps, step) != steps.end();
}

bool share_an_arm(const WaitingLeg& a, const WaitingLeg& b) {
  return std::ranges::any_of(
      a.arms, [&](ArmId arm) { return std::ranges::find(b.arms, arm) != b.arms.end(); });
}

}  // namespace

// Searches depth first, in the given order if possible. Unknown passages count as free.
class SafeSequence::Search {
 public:
  Search(SafeSequence& owner, const Order& legs) : owner_(owner), legs_(legs) {}

  bool run(const State& state, std::uint32_t done) {
    if (order.size() == legs_.size()) return true;
    if (seen_.size() >= kStatesMax || !seen_.insert(done).second) return false;
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      if ((done >> i & 1U) != 0 || !is_next(i, done)) continue;
      if (owner_.passes(*legs_[i], state, nullptr) == Passes::blocked) continue;
      State then = state;
      move(then, *legs_[i]);
      order.push_back(legs_[i]);
      if (run(then, done | 1U << i)) return true;
      order.pop_back();
    }
    return false;
  }

  Order order;

 private:
  [[nodiscard]] bool is_next(std::size_t leg, std::uint32_t done) const {
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      if ((done >> i & 1U) != 0 || i == leg) continue;
      if (i < leg && share_an_arm(*legs_[i], *legs_[leg])) return false;
      if (among(legs_[leg]->after, legs_[i]->step)) return false;
    }
    return true;
  }

  SafeSequence& owner_;
  const Order& legs_;
  std::set<std::uint32_t> seen_;
};

// Returns the legs that the group would overtake, and the legs that come soon.
SafeSequence::Concerned SafeSequence::concerned(const std::vector<StepId>& group,
                                                const State& then) {
  std::size_t left = 0;
  std::size_t far = 0;
  if (then != stands_) {
    for (StepId step : group) {
      if (index_.at(step)->placed) {
        ++left;
      } else {
        far = kFar;
      }
    }
  }
  Concerned found;
  for (Leg& leg : sequence_) {
    if (left == 0 && found.legs.size() >= std::max(far, kKnownAhead)) break;
    if (!among(group, leg.step)) {
      found.legs.push_back(&leg);
      if (left > 0 || found.legs.size() <= far) found.overtaken = found.legs.size();
    } else if (left > 0) {
      --left;
    }
  }
  return found;
}

std::optional<SafeSequence::Order> SafeSequence::search(const State& state, Order legs) {
  if (legs.size() > kSearched) return std::nullopt;
  Search search(*this, legs);
  if (!search.run(state, 0)) return std::nullopt;
  return std::move(search.order);
}

SafeSequence::Outlook SafeSequence::after(const std::vector<StepId>& group) {
  asked_ = group;
  found_.clear();
  Outlook outlook;
  place_more(outlook.ahead);
  State then = stands_;
  for (StepId step : group) move(then, *index_.at(step));
  for (;;) {
    const auto [legs, overtaken] = concerned(group, then);
    Walk needed = walk(then, std::span(legs).first(overtaken));
    Walk ahead = needed.blocked != nullptr ? needed : walk(then, legs);
    if (ahead.blocked == nullptr) {
      const auto further = static_cast<std::ptrdiff_t>(needed.unknown.size());
      outlook.unknown = std::move(needed.unknown);
      outlook.ahead.insert(outlook.ahead.end(), ahead.unknown.begin() + further,
                           ahead.unknown.end());
      break;
    }
    bool mended = false;
    if (auto answer = mend(then, legs, ahead, mended)) return *answer;
    if (mended) break;
  }
  if (!outlook.unknown.empty() || unplaced_.empty()) return outlook;
  if (index_.size() > kSearched + group.size()) {
    outlook.all = false;
    return outlook;
  }
  Order all = all_that_may_go(group);
  if (std::ranges::all_of(all, &Leg::placed)) return outlook;
  const auto order = search(then, std::move(all));
  outlook.all = order.has_value();
  if (!order) return outlook;
  Walk as_found = walk(then, *order);
  if (as_found.unknown.empty()) found_ = *order;
  std::ranges::move(as_found.unknown, std::back_inserter(outlook.ahead));
  return outlook;
}

// Handles a leg that is blocked after the group: finds another order of the first legs, or returns
// that the group waits. A leg that is blocked without the group, too, is moved or taken out.
std::optional<SafeSequence::Outlook> SafeSequence::mend(const State& then, const Order& legs,
                                                        const Walk& walk_then, bool& mended) {
  Leg& blocked = *walk_then.blocked;
  const Order front(legs.begin(),
                    legs.begin() + static_cast<std::ptrdiff_t>(std::min(legs.size(), kSearched)));
  if (std::ranges::find(front, &blocked) != front.end()) {
    if (auto order = search(then, front)) {
      order->insert(order->end(), legs.begin() + static_cast<std::ptrdiff_t>(front.size()),
                    legs.end());
      Walk ahead = walk(then, *order);
      if (ahead.blocked == nullptr) {
        if (!ahead.unknown.empty()) return Outlook{.unknown = std::move(ahead.unknown)};
        found_ = std::move(*order);
        mended = true;
        return std::nullopt;
      }
    }
  }
  Order as_it_is;
  for (Leg& leg : sequence_) {
    as_it_is.push_back(&leg);
    if (&leg == &blocked) break;
  }
  Walk now = walk(stands_, as_it_is);
  if (now.blocked == nullptr) {
    if (!now.unknown.empty()) return Outlook{.unknown = std::move(now.unknown)};
    return Outlook{.unknown = {},
                   .ahead = {},
                   .first = blocked.step,
                   .in_the_way = walk_then.in_the_way,
                   .block = walk_then.block};
  }
  Order first;
  for (auto leg = sequence_.begin(); leg != sequence_.end() && first.size() < kSearched; ++leg) {
    first.push_back(&*leg);
  }
  const auto order = search(stands_, first);
  if (!order) {
    take_out(*now.blocked);
    return std::nullopt;
  }
  Walk other = walk(stands_, *order);
  if (!other.unknown.empty()) return Outlook{.unknown = std::move(other.unknown)};
  const bool again = *order == first;  // the blocked leg comes later
  if (again) {
    take_out(*now.blocked);
  } else {
    put_in_order(*order);
  }
  return std::nullopt;
}

// ---- Legs that are not in the sequence ----

// Returns the legs that are neither cut nor behind one that is.
SafeSequence::Order SafeSequence::all_that_may_go(const std::vector<StepId>& but) {
  Order legs;
  std::vector<bool> barred(stands_.size(), false);
  std::set<StepId> left;
  for (Legs* list : {&sequence_, &unplaced_}) {
    for (Leg& leg : *list) {
      if (among(but, leg.step)) continue;
      const bool goes = !leg.cut && std::ranges::none_of(leg.arms, [&](ArmId arm) {
        return barred[arm.index()];
      }) && std::ranges::none_of(leg.after, [&](StepId step) { return left.contains(step); });
      if (goes) {
        legs.push_back(&leg);
        continue;
      }
      left.insert(leg.step);
      for (ArmId arm : leg.arms) barred[arm.index()] = true;
    }
  }
  return legs;
}

void SafeSequence::place_more(std::vector<Passage>& unknown) {
  if (unplaced_.empty() || tried_) return;
  if (index_.size() > kSearched) return place_behind(unknown);
  Order all = all_that_may_go({});
  tried_ = true;
  if (all.size() == sequence_.size()) return;
  const auto order = search(stands_, std::move(all));
  if (!order) return;
  Walk ahead = walk(stands_, *order);
  unknown = std::move(ahead.unknown);
  tried_ = unknown.empty();
  if (tried_) put_in_order(*order);
}

// Places the first of many legs behind the sequence.
void SafeSequence::place_behind(std::vector<Passage>& unknown) {
  State state = ends_;
  for (auto leg = unplaced_.rbegin(); leg != unplaced_.rend(); ++leg) {
    for (std::size_t i = 0; i < leg->arms.size(); ++i) state[leg->arms[i].index()] = leg->from[i];
  }
  std::vector<bool> passed_over(state.size(), false);
  std::size_t looked_at = 0;
  for (auto leg = unplaced_.begin(); leg != unplaced_.end() && looked_at < kSearched; ++looked_at) {
    const auto here = leg++;
    const bool behind = std::ranges::any_of(
        here->arms, [&](ArmId arm) { return static_cast<bool>(passed_over[arm.index()]); });
    const bool free = !behind && !here->cut && std::ranges::all_of(here->after, [&](StepId step) {
      const auto known = index_.find(step);
      return known == index_.end() || known->second->placed;
    }) && passes(*here, state, &unknown) == Passes::free;
    if (!free) {
      for (ArmId arm : here->arms) passed_over[arm.index()] = true;
      continue;
    }
    move(state, *here);
    here->placed = true;
    for (ArmId arm : here->arms) --unplaced_legs_[arm.index()];
    sequence_.splice(sequence_.end(), unplaced_, here);
  }
  tried_ = unknown.empty();
}

void SafeSequence::put_in_order(const Order& order) {
  for (auto leg = order.rbegin(); leg != order.rend(); ++leg) {
    const auto here = index_.at((*leg)->step);
    if (!here->placed) {
      for (ArmId arm : here->arms) --unplaced_legs_[arm.index()];
    }
    sequence_.splice(sequence_.begin(), here->placed ? sequence_ : unplaced_, here);
    here->placed = true;
  }
}

// Takes the leg out, and all legs that follow it.
void SafeSequence::take_out(Leg& leg) {
  Legs out;
  std::vector<bool> cut_off(stands_.size(), false);
  std::set<StepId> left;
  for (auto next = index_.at(leg.step); next != sequence_.end();) {
    const auto here = next++;
    const bool goes = &*here == &leg || std::ranges::any_of(here->arms, [&](ArmId arm) {
      return cut_off[arm.index()];
    }) || std::ranges::any_of(here->after, [&](StepId step) { return left.contains(step); });
    if (!goes) continue;
    here->placed = false;
    left.insert(here->step);
    for (ArmId arm : here->arms) {
      cut_off[arm.index()] = true;
      ++unplaced_legs_[arm.index()];
    }
    out.splice(out.end(), sequence_, here);
  }
  unplaced_.splice(unplaced_.begin(), out);
  tried_ = false;
}

}  // namespace armloom
