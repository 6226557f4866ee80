#include "core/scheduler/orders/passing_orders.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "core/scheduler/orders/open_orders.h"

namespace armloom {
namespace {

constexpr double kWeightOfSum = 3.0;  // of the sum over arms, beside the last one's end
constexpr int kPasses = 3;            // of changing single choices
constexpr std::size_t kFreeMax = 24;  // choices that are changed at all

// Smaller is better, entry by entry.
using Cost = std::vector<double>;

class Search {
 public:
  Search(OpenOrders& open, const std::vector<Duration>& work_behind)
      : open_(open), work_behind_(work_behind), prediction_(open.predicted()) {
    cost_ = cost_of(prediction_);
    const std::vector<OrderChoice*> free = free_choices();
    if (free.size() <= kTriedInFull) {
      try_all(free);
    } else {
      change_single(free);
    }
  }
  [[nodiscard]] Prediction best() { return std::move(prediction_); }

 private:
  [[nodiscard]] Cost cost_of(const Prediction& prediction) const {
    Cost cost{static_cast<double>(prediction.stuck.size())};
    std::map<int, std::map<ArmId, double>, std::greater<>> finish;  // by priority, arm
    for (std::size_t m = 0; m < open_.motions().size(); ++m) {
      for (const ArmId arm : open_.motions()[m].arms) {
        double& last = finish[open_.motions()[m].priority][arm];
        last = std::max(last, to_seconds(prediction.ends[m]));
      }
    }
    for (const auto& [priority, arms] : finish) {
      double last = 0.0, sum = 0.0;
      for (const auto& [arm, end] : arms) {
        last = std::max(last, end + to_seconds(work_behind_[arm.index()]));
        sum += end;
      }
      cost.push_back(last + kWeightOfSum * sum);
    }
    return cost;
  }

  // Those of the candidates' regions, then those of motions that a candidate meets.
  std::vector<OrderChoice*> free_choices() {
    const auto& orders = open_.orders();
    std::vector<bool> met(open_.motions().size(), false);
    for (std::size_t d = open_.decided(); d < orders.size(); ++d) {
      met[orders[d].a] = met[orders[d].b] = true;
    }
    std::vector<OrderChoice*> free, further;
    for (OrderChoice& choice : open_.choices()) {
      if (choice.options.size() < 2) continue;
      const bool own = std::ranges::any_of(choice.members, [&](const OrderChoice::Member& member) {
        return member.order >= open_.decided();
      });
      const bool near = std::ranges::any_of(choice.members, [&](const OrderChoice::Member& member) {
        return met[orders[member.order].a] || met[orders[member.order].b];
      });
      if (own) free.push_back(&choice);
      if (near && !own) further.push_back(&choice);
    }
    free.insert(free.end(), further.begin(), further.end());
    if (free.size() > kFreeMax) free.resize(kFreeMax);
    return free;
  }

  void try_all(const std::vector<OrderChoice*>& free) {
    std::size_t best = 0;
    for (std::size_t which = 1; which < (std::size_t{1} << free.size()); ++which) {
      assign(free, which);
      if (is_better()) best = which;
    }
    assign(free, best);
  }
  void assign(const std::vector<OrderChoice*>& free, std::size_t which) {
    for (std::size_t i = 0; i < free.size(); ++i) {
      open_.set(*free[i], free[i]->options[which >> i & 1U]);
    }
  }

  void change_single(const std::vector<OrderChoice*>& free) {
    for (int pass = 0; pass < kPasses; ++pass) {
      bool changed = false;
      for (OrderChoice* choice : free) {
        open_.set(*choice, !choice->value);
        if (is_better()) {
          changed = true;
        } else {
          open_.set(*choice, !choice->value);
        }
      }
      if (!changed) return;
    }
  }

  bool is_better() {
    constexpr double kLeast_s = 1e-3;
    Prediction prediction = open_.predicted();
    Cost cost = cost_of(prediction);
    for (std::size_t i = 0; i < cost.size(); ++i) {
      if (cost[i] > cost_[i] - kLeast_s && cost[i] < cost_[i] + kLeast_s) continue;
      if (cost[i] > cost_[i]) return false;
      cost_ = std::move(cost);
      prediction_ = std::move(prediction);
      return true;
    }
    return false;
  }

  OpenOrders& open_;
  const std::vector<Duration>& work_behind_;
  Prediction prediction_;
  Cost cost_;
};

}  // namespace

PassingOrders cheapest_orders(const OrderQuestion& question) {
  OpenOrders open(question);
  if (open.blocked()) return open.refused({});
  Prediction best = Search(open, question.work_behind).best();
  return best.stuck.empty() ? open.admitted(std::move(best)) : open.stuck(best);
}

PassingOrders orders_apart(const OrderQuestion& question) {
  OpenOrders open(question);
  std::vector<std::size_t> met;
  for (std::size_t d = open.decided(); d < open.orders().size(); ++d) met.push_back(d);
  if (open.blocked() || !met.empty()) return open.refused(met);
  return open.admitted(open.predicted());
}

}  // namespace armloom
