#include "core/collision/scene/out_of_reach.h"

#include <algorithm>
#include <map>
#include <queue>

#include "core/collision/scene/swept_link.h"
#include "core/trajectory/validate.h"

namespace armloom {
namespace {

constexpr double kRounding_m = 1e-6;

// Searches for a part of each link that may be too close to each other (SweptLink::Part). Examines
// the closest pairs of parts first.
class Search {
 public:
  Search(SweptLink& a, SweptLink& b, double limit_m) : a_(a), b_(b), limit_m_(limit_m) {}

  // Returns true if the links are proven to keep `limit_m`. Subtracts the number of comparisons
  // from `budget`.
  bool proves(int& budget) {
    if (!add(0, 0, budget)) return false;
    while (!open_.empty()) {
      const Open next = open_.top();
      open_.pop();
      if (!split(next, budget)) return false;
    }
    return true;
  }

 private:
  struct Open {
    double least_m;  // lower bound of the distance of the two parts
    std::size_t of_a;
    std::size_t of_b;
    bool operator<(const Open& other) const { return least_m > other.least_m; }
  };

  // Compares two parts and keeps them for halving if they are not proven apart. Returns false if
  // the search must end: the links may meet, or the budget is used up.
  bool add(std::size_t of_a, std::size_t of_b, int& budget) {
    if (budget-- <= 0) return false;
    const PartGap gap = gap_between(a_.part(of_a), b_.part(of_b));
    if (gap.at_centers_m < limit_m_) return false;
    if (gap.least_m < limit_m_) open_.push({gap.least_m, of_a, of_b});
    return true;
  }

  bool split(const Open& open, int& budget) {
    const bool a_first = a_.part(open.of_a).motion_m >= b_.part(open.of_b).motion_m;
    for (const bool of_a : {a_first, !a_first}) {
      const auto half = of_a ? a_.halve(open.of_a) : b_.halve(open.of_b);
      if (!half) continue;
      return of_a ? add(*half, open.of_b, budget) && add(*half + 1, open.of_b, budget)
                  : add(open.of_a, *half, budget) && add(open.of_a, *half + 1, budget);
    }
    return false;
  }

  SweptLink& a_;
  SweptLink& b_;
  double limit_m_;
  std::priority_queue<Open> open_;
};

}  // namespace

std::set<LinkPair> pairs_out_of_reach(const PlanningScene::Bodies& bodies) {
  const Cell& cell = *bodies.cell;
  const double limit_m = std::max(cell.clearances.clearance_m, kTouching_m) + kRounding_m;
  std::map<LinkId, SweptLink> swept;
  const auto swept_link = [&](LinkId link) -> SweptLink& {
    const double beyond = cell.tracking_error(cell.link(link).robot) +
                          cell.execution.start_tolerance_rad + kPositionOvershoot;
    return swept.try_emplace(link, bodies, link, beyond).first->second;
  };
  std::set<LinkPair> proven;
  int budget = kComparisonsPerCell;
  for (const auto& [pair, place] : cell.allowed.claimed_pairs) {
    if (cell.allowed.allows(pair.first, pair.second)) continue;
    int of_pair = std::min(budget, kComparisonsPerPair);
    budget -= of_pair;
    if (Search(swept_link(pair.first), swept_link(pair.second), limit_m).proves(of_pair)) {
      proven.insert(pair);
    }
    budget += std::max(of_pair, 0);
  }
  return proven;
}

}  // namespace armloom
