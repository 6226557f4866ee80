#include "core/precedence/order_search.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace armloom {
namespace {

constexpr double kLeast_s = 1e-3;  // smaller differences do not matter

}  // namespace

OrderSearch::OrderSearch(OpenOrders& open, const std::vector<Duration>& work_behind)
    : open_(open),
      work_behind_(work_behind),
      weight_of_sum_(weight_of_sum(work_behind)),
      made_max_(std::clamp(kOrdersFollowedMax / std::max<std::size_t>(open.orders().size(), 1),
                           kPredictionsLeast, kPredictionsMax)) {
  const auto& motions = open.motions();
  std::set<int> priorities;
  for (const CoordinatedMotion& motion : motions) priorities.insert(motion.priority);
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const auto smaller = std::distance(priorities.begin(), priorities.find(motions[m].priority));
    urgency_.push_back(open.leads(m) ? static_cast<double>(smaller) : 0.0);
  }
}

Prediction OrderSearch::run() {
  std::vector<Side> sides(open_.choices().size()), as_is;
  const std::vector<bool> concerned = motions_concerned();
  for (std::size_t c = 0; c < sides.size(); ++c) {
    const OrderChoice& choice = open_.choices()[c];
    as_is.push_back({Side::first, choice.at_start});
    const bool is_near = std::ranges::any_of(choice.members, [&](const auto& member) {
      const OpenOrder& order = open_.orders()[member.order];
      return concerned[order.a] && concerned[order.b];
    });
    if (choice.options.size() < 2 || !is_near) sides[c] = as_is[c];
  }
  Node now = made(as_is);
  Prediction otherwise = now.prediction;
  if (now.prediction.stuck.empty()) note(now);
  dive(made(std::move(sides)));
  while (!waiting_.empty() && made_ < made_max_) {
    std::ranges::pop_heap(waiting_, is_later);
    Node next = std::move(waiting_.back());
    waiting_.pop_back();
    if (is_better(next.cost)) dive(std::move(next));
  }
  if (!best_) {
    set(as_is);
    return otherwise;
  }
  wait_where_it_is_cheaper();
  set(best_->sides);
  return std::move(best_->prediction);
}

double OrderSearch::weight_of_sum(const std::vector<Duration>& work_behind) {
  const bool more =
      std::ranges::any_of(work_behind, [](Duration work) { return work > Duration{}; });
  return more ? kWeightOfSumBeforeMore : kWeightOfSum;
}

bool OrderSearch::is_later(const Node& a, const Node& b) {
  return a.cost != b.cost ? a.cost > b.cost : a.number > b.number;
}

// Returns the motions in the queues of the candidates and of motions that they meet; all motions if
// there are no candidates.
std::vector<bool> OrderSearch::motions_concerned() const {
  const auto& motions = open_.motions();
  if (open_.first_candidate() == motions.size()) return std::vector<bool>(motions.size(), true);
  std::vector<bool> lanes(work_behind_.size(), false);
  const auto add_lanes_of = [&](std::size_t motion) {
    for (const ArmId arm : motions[motion].arms) lanes[arm.index()] = true;
  };
  for (std::size_t m = open_.first_candidate(); m < motions.size(); ++m) add_lanes_of(m);
  for (std::size_t d = open_.decided(); d < open_.orders().size(); ++d) {
    add_lanes_of(open_.orders()[d].a);
    add_lanes_of(open_.orders()[d].b);
  }
  std::vector<bool> concerned;
  for (const CoordinatedMotion& motion : motions) {
    concerned.push_back(std::ranges::any_of(
        motion.arms, [&](ArmId arm) { return static_cast<bool>(lanes[arm.index()]); }));
  }
  return concerned;
}

double OrderSearch::cost_of(const Prediction& prediction) const {
  constexpr double kNever = -1.0;
  std::vector<double> finish(work_behind_.size(), kNever);  // by arm
  double urgent = 0.0;
  for (std::size_t m = 0; m < open_.motions().size(); ++m) {
    const double end = to_seconds(prediction.ends[m]);
    for (const ArmId arm : open_.motions()[m].arms)
      finish[arm.index()] = std::max(finish[arm.index()], end);
    urgent += urgency_[m] * end;
  }
  double last = 0.0, sum = 0.0;
  for (std::size_t arm = 0; arm < finish.size(); ++arm) {
    if (finish[arm] == kNever) continue;
    last = std::max(last, finish[arm] + to_seconds(work_behind_[arm]));
    sum += finish[arm];
  }
  return last + weight_of_sum_ * sum + kWeightOfPriority * urgent;
}

bool OrderSearch::is_better(double cost) const { return !best_ || cost < best_->cost - kLeast_s; }

void OrderSearch::set(const std::vector<Side>& sides) {
  for (std::size_t c = 0; c < sides.size(); ++c) {
    OrderChoice& choice = open_.choices()[c];
    if (sides[c].side == Side::open) {
      open_.leave_open(choice);
    } else {
      open_.set(choice, choice.options[sides[c].side == Side::first ? 0 : 1], sides[c].at_start);
    }
  }
}

OrderSearch::Node OrderSearch::made(std::vector<Side> sides) {
  set(sides);
  Prediction prediction = open_.predicted();
  const double cost = cost_of(prediction);
  return {std::move(sides), std::move(prediction), cost, made_++};
}

// Returns the open choice that the prediction violates first, whichever side passes first.
std::optional<std::size_t> OrderSearch::first_broken(const Node& node) {
  std::optional<std::size_t> first;
  Duration at{};
  for (std::size_t c = 0; c < node.sides.size(); ++c) {
    if (node.sides[c].side != Side::open) continue;
    const OrderChoice& choice = open_.choices()[c];
    const auto one = open_.broken_at(choice, choice.options[0], node.prediction);
    if (!one) continue;
    const auto other = open_.broken_at(choice, choice.options[1], node.prediction);
    if (!other) continue;
    if (first && std::max(*one, *other) >= at) continue;
    first = c;
    at = std::max(*one, *other);
  }
  return first;
}

// Decides one violated choice after the other, each on its cheaper side. Keeps the other sides for
// later.
void OrderSearch::dive(Node node) {
  for (;;) {
    if (!node.prediction.stuck.empty() || !is_better(node.cost)) return;
    const auto choice = first_broken(node);
    if (!choice) return note(node);
    if (made_ >= 2 * made_max_) return;
    Node one = cheaper_way(node, *choice, true), other = cheaper_way(node, *choice, false);
    const bool one_ends = one.prediction.stuck.empty(), other_ends = other.prediction.stuck.empty();
    const bool takes_one = one_ends && (!other_ends || one.cost <= other.cost);
    node = std::move(takes_one ? one : other);
    Node& left = takes_one ? other : one;
    if (!left.prediction.stuck.empty()) continue;
    waiting_.push_back(std::move(left));
    std::ranges::push_heap(waiting_, is_later);
  }
}

// Compares two places to wait. A stop on the path costs time; at its start, an arm may block
// others.
OrderSearch::Node OrderSearch::cheaper_way(const Node& node, std::size_t choice, bool first) {
  std::vector<Side> sides = node.sides;
  sides[choice] = {first ? Side::first : Side::other, false};
  Node on_its_way = made(sides);
  sides[choice].at_start = true;
  Node at_its_start = made(std::move(sides));
  if (!at_its_start.prediction.stuck.empty()) return on_its_way;
  if (!on_its_way.prediction.stuck.empty()) return at_its_start;
  return at_its_start.cost < on_its_way.cost ? at_its_start : on_its_way;
}

void OrderSearch::wait_where_it_is_cheaper() {
  for (std::size_t c = 0; c < best_->sides.size() && made_ < 3 * made_max_; ++c) {
    std::vector<Side> sides = best_->sides;
    sides[c].at_start = !sides[c].at_start;
    Node turned = made(std::move(sides));
    if (turned.prediction.stuck.empty() && is_better(turned.cost)) best_ = std::move(turned);
  }
}

// Stores the node if it is the best one. Open choices are set as the prediction has them.
void OrderSearch::note(const Node& node) {
  if (!is_better(node.cost)) return;
  best_ = node;
  for (std::size_t c = 0; c < node.sides.size(); ++c) {
    if (node.sides[c].side != Side::open) continue;
    const OrderChoice& choice = open_.choices()[c];
    const bool holds = !open_.broken_at(choice, choice.options[0], node.prediction);
    best_->sides[c].side = holds ? Side::first : Side::other;
  }
}

}  // namespace armloom
