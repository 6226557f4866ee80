#include "core/precedence/order_ties.h"

#include <algorithm>

namespace armloom {
namespace {

bool overlap(Duration from_1, Duration to_1, Duration from_2, Duration to_2) {
  return from_1 <= to_2 && from_2 <= to_1;
}

// Whether both regions hold the rest at which one motion of an arm ends and the next one begins,
// for the same states of the one that passes there. `d_side`: the arm's motion is d's A.
bool meet_at_rest(const ConflictRegion& d, bool d_side, const ConflictRegion& e, bool e_side,
                  Duration end) {
  for (const ProgressBox& last : d.boxes) {
    if ((d_side ? last.to_a : last.to_b) < end) continue;
    for (const ProgressBox& first : e.boxes) {
      if ((e_side ? first.from_a : first.from_b) > Duration{}) continue;
      if (overlap(d_side ? last.from_b : last.from_a, d_side ? last.to_b : last.to_a,
                  e_side ? first.from_b : first.from_a, e_side ? first.to_b : first.to_a)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

OrderTies::OrderTies(const std::vector<OpenOrder>& orders,
                     const std::vector<CoordinatedMotion>& motions, const MotionChains& chains)
    : of_(orders.size()) {
  std::vector<std::size_t> following;  // orders of a motion that follows another one
  for (std::size_t e = 0; e < orders.size(); ++e) {
    const bool follows = !chains.before(orders[e].a).empty() || !chains.before(orders[e].b).empty();
    if (follows) following.push_back(e);
  }
  for (std::size_t d = 0; d < orders.size(); ++d) {
    for (const std::size_t e : following) {
      if (d != e) tie(d, e, orders, motions, chains);
    }
  }
}

// If d ends where e begins, in the way of the same other motion.
void OrderTies::tie(std::size_t d, std::size_t e, const std::vector<OpenOrder>& orders,
                    const std::vector<CoordinatedMotion>& motions, const MotionChains& chains) {
  for (const bool d_side : {true, false}) {
    for (const bool e_side : {true, false}) {
      const std::size_t ends = d_side ? orders[d].a : orders[d].b;
      const std::size_t begins = e_side ? orders[e].a : orders[e].b;
      const std::size_t passes_d = d_side ? orders[d].b : orders[d].a;
      const std::size_t passes_e = e_side ? orders[e].b : orders[e].a;
      const auto& before = chains.before(begins);
      if (passes_d != passes_e || std::ranges::find(before, ends) == before.end()) continue;
      if (!meet_at_rest(orders[d].region, d_side, orders[e].region, e_side,
                        motions[ends].duration)) {
        continue;
      }
      of_[d].push_back({e, d_side != e_side});
      of_[e].push_back({d, d_side != e_side});
    }
  }
}

}  // namespace armloom
