#include "core/precedence/open_orders.h"

#include <algorithm>
#include <map>
#include <utility>

namespace armloom {
namespace {

using Member = OrderChoice::Member;

std::size_t variant(bool a_first, bool at_start) {
  return (a_first ? 0U : 1U) + (at_start ? 2U : 0U);
}

ProgressBox seen_by(bool a, const ProgressBox& box) { return a ? box : turned_around(box); }

// Returns true if both regions contain the rest at which a motion of an arm ends, after `end`, and
// the next one begins, for the same states of the passing motion. `d_side`: the arm's motion is A
// in region d.
bool meet_at_rest(const ConflictRegion& d, bool d_side, const ConflictRegion& e, bool e_side,
                  Duration end) {
  return std::ranges::any_of(d.boxes, [&](const ProgressBox& in_d) {
    const ProgressBox last = seen_by(d_side, in_d);
    return last.to_a >= end && std::ranges::any_of(e.boxes, [&](const ProgressBox& in_e) {
             const ProgressBox first = seen_by(e_side, in_e);
             return first.from_a <= Duration{} && last.from_b <= first.to_b &&
                    first.from_b <= last.to_b;
           });
  });
}

std::vector<CoordinatedMotion> both(const std::vector<CoordinatedMotion>& admitted,
                                    const std::vector<CoordinatedMotion>& candidates) {
  std::vector<CoordinatedMotion> all = admitted;
  all.insert(all.end(), candidates.begin(), candidates.end());
  return all;
}

}  // namespace

OpenOrders::OpenOrders(const OrderQuestion& question)
    : motions_(both(question.admitted, question.candidates)),
      first_candidate_(question.admitted.size()),
      chains_(motions_),
      held_at_(question.held_at) {
  for (const Precedence& precedence : question.precedences) add_decided(precedence);
  decided_ = orders_.size();
  for (const PairRegions& pair : question.regions) add(pair);
  collect_choices();
}

std::optional<std::size_t> OpenOrders::index_of(StepId step) const {
  const auto found = std::ranges::find(motions_, step, &CoordinatedMotion::step);
  if (found == motions_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - motions_.begin());
}

// ---- Open orders ----

void OpenOrders::add(const PairRegions& pair) {
  const std::size_t a = *index_of(pair.a);
  if (const auto* arm = std::get_if<ArmId>(&pair.b)) {
    for (const ConflictRegion& region : pair.regions) {
      answer_.blockers.push_back(
          {pair.a, std::nullopt, *arm, region.proximity, region.time_a, region.time_b});
      answer_.in_the_way.push_back(*arm);
    }
    return;
  }
  const auto b = index_of(std::get<StepId>(pair.b));
  if (!b) return;  // has ended meanwhile
  for (const ConflictRegion& region : pair.regions) add(a, *b, region);
}

// The order may be reversed until the first motion has authority in the region.
void OpenOrders::add_decided(const Precedence& precedence) {
  const std::size_t a = *index_of(precedence.first());
  const std::size_t b = *index_of(precedence.second());
  OpenOrder order{.a = a, .b = b, .region = precedence.region()};
  order.b_may = !motions_[a].outlook.keeps_its_place &&
                std::ranges::all_of(order.region.boxes, [&](const ProgressBox& box) {
                  return motions_[b].is_beyond(box.to_b) || may_pass_second(a, b, box);
                });
  order.at_start = precedence.waits_at_start();
  order.made[variant(true, order.at_start)] = precedence;
  orders_.push_back(std::move(order));
}

void OpenOrders::add(std::size_t a, std::size_t b, const ConflictRegion& region) {
  OpenOrder order{.a = a, .b = b, .region = region, .prefers_a = a < b};
  std::erase_if(order.region.boxes, [&](const ProgressBox& box) {
    return motions_[a].is_beyond(box.to_a) || motions_[b].is_beyond(box.to_b);
  });
  if (order.region.boxes.empty()) return;
  for (const ProgressBox& box : order.region.boxes) {
    order.a_may = order.a_may && may_pass_second(b, a, turned_around(box));
    order.b_may = order.b_may && may_pass_second(a, b, box);
    if (rests_at(a, box.to_a, b)) note_in_the_way(a);
    if (rests_at(b, box.to_b, a)) note_in_the_way(b);
  }
  if (order.a_may && order.b_may) {
    const bool a_keeps = motions_[a].outlook.keeps_its_place;
    const bool b_keeps = motions_[b].outlook.keeps_its_place;
    order.a_may = a_keeps || !b_keeps;
    order.b_may = b_keeps || !a_keeps;
  }
  orders_.push_back(std::move(order));
}

// Returns false if `second` (A) has, or may have, entered the box when `first` (B) passes, or if
// `first` stays in the box at its end.
bool OpenOrders::may_pass_second(std::size_t second, std::size_t first,
                                 const ProgressBox& box) const {
  return !reaches(second, box.from_a, first) && !rests_at(first, box.to_b, second);
}

// Returns true if the motion has, or may have, entered what begins at `from` when the other one
// passes. At its start it is there now, or gets there by a motion before the other one.
bool OpenOrders::reaches(std::size_t motion, Duration from, std::size_t other) const {
  if (from < motions_[motion].authority) return true;
  const bool at_start = from <= Duration{} && motions_[motion].authority <= Duration{};
  if (!at_start) return false;
  const auto& before = chains_.before(motion);
  return before.size() < motions_[motion].arms.size() ||
         std::ranges::any_of(before, [&](std::size_t ahead) {
           return ahead < other && share_an_arm(motions_[ahead], motions_[other]);
         });
}

// Returns true if the motion ends before `to`, and no motion takes its arms away before the other
// one.
bool OpenOrders::rests_at(std::size_t motion, Duration to, std::size_t other) const {
  return to >= motions_[motion].duration &&
         !resting_for(motions_, motions_[motion].arms, motion, other).empty();
}

void OpenOrders::note_in_the_way(std::size_t motion) {
  for (const ArmId arm : motions_[motion].arms) answer_.in_the_way.push_back(arm);
}

// ---- Choices ----

// Two regions are one if an arm rests between two motions, one region ends at this rest, the other
// begins there, and the same motion of another arm passes both. Returns for each order the orders
// of the regions that its region touches so.
std::vector<std::vector<Member>> OpenOrders::joined_at_rests() const {
  std::vector<std::vector<Member>> joined(orders_.size());
  std::multimap<std::pair<std::size_t, std::size_t>, std::size_t> of_pair;
  for (std::size_t d = 0; d < orders_.size(); ++d) {
    of_pair.emplace(std::minmax(orders_[d].a, orders_[d].b), d);
  }
  for (std::size_t e = 0; e < orders_.size(); ++e) {
    for (const bool e_side : {true, false}) {  // true: the arm's motion is A
      const std::size_t begins = e_side ? orders_[e].a : orders_[e].b;
      const std::size_t passes = e_side ? orders_[e].b : orders_[e].a;
      for (const std::size_t ends : chains_.before(begins)) {
        const auto [first, last] = of_pair.equal_range(std::minmax(ends, passes));
        for (auto of = first; of != last; ++of) {
          const std::size_t d = of->second;
          const bool d_side = orders_[d].a == ends;
          if (!meet_at_rest(orders_[d].region, d_side, orders_[e].region, e_side,
                            motions_[ends].duration)) {
            continue;
          }
          joined[d].push_back({e, d_side != e_side});
          joined[e].push_back({d, d_side != e_side});
        }
      }
    }
  }
  return joined;
}

void OpenOrders::collect_choices() {
  const auto joined = joined_at_rests();
  std::vector<bool> seen(orders_.size(), false);
  for (std::size_t d = 0; d < orders_.size(); ++d) {
    if (seen[d]) continue;
    OrderChoice choice{.members = {{d, false}}};
    seen[d] = true;
    for (std::size_t i = 0; i < choice.members.size(); ++i) {  // grows
      const Member member = choice.members[i];
      for (const Member& tied : joined[member.order]) {
        if (seen[tied.order]) continue;
        seen[tied.order] = true;
        choice.members.push_back({tied.order, member.turned != tied.turned});
      }
    }
    for (const bool value : {false, true}) {  // the earlier one of the pair first
      const bool a_first = orders_[d].prefers_a ? !value : value;
      if (allowed(choice, a_first)) choice.options.push_back(a_first);
    }
    if (choice.options.empty()) {
      const auto of_candidate = std::ranges::find_if(
          choice.members, [this](const Member& member) { return member.order >= decided_; });
      if (of_candidate != choice.members.end()) report(of_candidate->order);
    } else {
      set(choice, choice.options.front(), orders_[d].at_start);
      choices_.push_back(std::move(choice));
    }
  }
}

bool OpenOrders::allowed(const OrderChoice& choice, bool a_first) const {
  return std::ranges::all_of(choice.members, [&](const Member& member) {
    const OpenOrder& order = orders_[member.order];
    return a_first != member.turned ? order.a_may : order.b_may;
  });
}

void OpenOrders::set(OrderChoice& choice, bool value, bool at_start) {
  choice.at_start = at_start;
  for (const Member& member : choice.members) {
    orders_[member.order].a_first = value != member.turned;
    orders_[member.order].at_start = at_start;
    orders_[member.order].is_open = false;
  }
}

void OpenOrders::leave_open(const OrderChoice& choice) {
  for (const Member& member : choice.members) orders_[member.order].is_open = true;
}

// ---- Predictions ----

const Precedence& OpenOrders::precedence(OpenOrder& order, bool a_first, bool at_start) {
  const CoordinatedMotion& first = motions_[a_first ? order.a : order.b];
  const CoordinatedMotion& second = motions_[a_first ? order.b : order.a];
  const bool begins = second.authority <= Duration{};
  std::optional<Precedence>& made = order.made[variant(a_first, at_start && begins)];
  if (!made) {
    made.emplace(motions_[order.a].step, motions_[order.b].step, order.region, a_first,
                 at_start && begins, second.outlook.pace / first.outlook.pace);
  }
  return *made;
}

std::optional<Duration> OpenOrders::broken_at(const OrderChoice& choice, bool value,
                                              const Prediction& prediction) {
  std::optional<Duration> broken;
  for (const Member& member : choice.members) {
    OpenOrder& order = orders_[member.order];
    const bool a_first = value != member.turned;
    const std::size_t first = a_first ? order.a : order.b, second = a_first ? order.b : order.a;
    for (const Precedence::Step& step : precedence(order, a_first, false).steps()) {
      if (step.until <= motions_[first].progress) continue;
      const auto passed = prediction.comes_to(first, step.until);
      const auto goes = prediction.goes_beyond(second, step.limit);
      if (goes && (!passed || *goes < *passed)) broken = std::min(broken.value_or(*goes), *goes);
    }
  }
  return broken;
}

std::vector<Dependency> OpenOrders::dependencies(std::size_t orders) {
  std::vector<Dependency> dependencies;
  dependencies.reserve(orders);
  for (std::size_t d = 0; d < orders; ++d) {
    OpenOrder& order = orders_[d];
    if (order.is_open) continue;
    dependencies.push_back({order.a_first ? order.a : order.b, order.a_first ? order.b : order.a,
                            &precedence(order, order.a_first, order.at_start)});
  }
  return dependencies;
}

// Ignores what holds the admitted motions now, because a candidate may take it away.
Prediction OpenOrders::predicted() {
  return predict(motions_, chains_, dependencies(orders_.size()));
}

Prediction OpenOrders::predicted_before() {
  return predict(std::span(motions_).first(first_candidate_), chains_, dependencies(decided_),
                 held_at_);
}

// ---- The answers ----

PassingOrders OpenOrders::admitted(Prediction prediction) {
  for (OpenOrder& order : orders_)
    answer_.precedences.push_back(precedence(order, order.a_first, order.at_start));
  answer_.prediction = std::move(prediction);
  return std::move(answer_);
}

PassingOrders OpenOrders::refused(const std::vector<std::size_t>& because) {
  for (std::size_t order : because) report(order);
  std::ranges::sort(answer_.in_the_way);
  const auto again = std::ranges::unique(answer_.in_the_way);
  answer_.in_the_way.erase(again.begin(), again.end());
  return std::move(answer_);
}

// Reports the candidates' own orders in the cycle.
PassingOrders OpenOrders::stuck(const Prediction& prediction) {
  const auto in_ring = [&](std::size_t motion) {
    return std::ranges::find(prediction.ring, motion) != prediction.ring.end();
  };
  std::vector<std::size_t> because;
  for (std::size_t d = decided_; d < orders_.size(); ++d) {
    if (in_ring(orders_[d].a) && in_ring(orders_[d].b)) because.push_back(d);
  }
  if (because.empty() && orders_.size() > decided_) because.push_back(decided_);
  return refused(because);
}

void OpenOrders::report(std::size_t d) {
  const OpenOrder& order = orders_[d];
  const ConflictRegion& region = order.region;
  const bool own_is_a = order.a >= first_candidate_;
  answer_.blockers.push_back(
      {.blocked = motions_[own_is_a ? order.a : order.b].step,
       .other = motions_[own_is_a ? order.b : order.a].step,
       .arm = std::nullopt,
       .proximity = own_is_a ? region.proximity : turned_around(region.proximity),
       .own_time = own_is_a ? region.time_a : region.time_b,
       .other_time = own_is_a ? region.time_b : region.time_a});
}

}  // namespace armloom
