#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/precedence/motion_chains.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// A conflict region of two motions (indices), and which may pass first.
struct OpenOrder {
  std::size_t a;
  std::size_t b;
  ConflictRegion region;  // only the part still ahead
  bool a_may = true;
  bool b_may = true;
  bool prefers_a = true;
  bool a_first = true;                                 // the present setting
  bool at_start = false;                               // the second waits at its start
  bool is_open = false;                                // undecided: delays no motion
  std::array<std::optional<Precedence>, 4> made = {};  // cache, by a_first and at_start
};

// Orders that are decided together, with equal or `turned` sides. For example, the regions before
// and after an arm's rest that the same other motion passes.
struct OrderChoice {
  struct Member {
    std::size_t order;
    bool turned;
  };
  std::vector<Member> members;
  std::vector<bool> options = {};  // values of "a first" of the first member, preferred first
  bool at_start = false;           // the present setting
};

// The open decisions in all regions of admitted motions and candidates. An order can be reversed
// until the motion that would have to wait has authority in the region, because no motion is made
// to go back.
class OpenOrders {
 public:
  explicit OpenOrders(const OrderQuestion& question);

  [[nodiscard]] const std::vector<CoordinatedMotion>& motions() const { return motions_; }
  [[nodiscard]] std::size_t first_candidate() const { return first_candidate_; }
  // Returns true if no other motion of its arms precedes it.
  [[nodiscard]] bool leads(std::size_t motion) const { return chains_.before(motion).empty(); }
  // Existing orders first, `decided` of them.
  [[nodiscard]] const std::vector<OpenOrder>& orders() const { return orders_; }
  [[nodiscard]] std::size_t decided() const { return decided_; }
  // Unless blocked, each choice has an option, and its first option is set.
  [[nodiscard]] std::vector<OrderChoice>& choices() { return choices_; }
  [[nodiscard]] bool blocked() const { return !answer_.blockers.empty(); }

  // `at_start`: the second motion waits at its start, if still there, instead of on its path.
  void set(OrderChoice& choice, bool value, bool at_start = false);
  // Makes the choice delay no motion in predictions.
  void leave_open(const OrderChoice& choice);
  // Returns when the prediction first violates this side of the choice: the second motion enters a
  // region before the first has left it; nullopt if never.
  [[nodiscard]] std::optional<Duration> broken_at(const OrderChoice& choice, bool value,
                                                  const Prediction& prediction);
  // Predict with the orders as set, or only with existing ones among admitted motions.
  [[nodiscard]] Prediction predicted();
  [[nodiscard]] Prediction predicted_before();

  // The answers: admitted as set; refused because of these orders; stuck in a cycle.
  [[nodiscard]] PassingOrders admitted(Prediction prediction);
  [[nodiscard]] PassingOrders refused(const std::vector<std::size_t>& because);
  [[nodiscard]] PassingOrders stuck(const Prediction& prediction);

 private:
  [[nodiscard]] std::optional<std::size_t> index_of(JobId job) const;
  void add(const PairRegions& pair);
  void add_decided(const Precedence& precedence);
  void add(std::size_t a, std::size_t b, const ConflictRegion& region);
  [[nodiscard]] bool reaches(std::size_t motion, Duration from, std::size_t other) const;
  [[nodiscard]] bool blocks_end(std::size_t motion, Duration to, std::size_t other) const;
  void note_in_the_way(std::size_t motion);
  void collect_choices();
  [[nodiscard]] bool allowed(const OrderChoice& choice, bool a_first) const;
  [[nodiscard]] const Precedence& precedence(OpenOrder& order, bool a_first, bool at_start);
  [[nodiscard]] Prediction predicted(const std::vector<MotionAhead>& motions, std::size_t orders);
  void report(std::size_t order);

  std::vector<CoordinatedMotion> motions_;
  std::size_t first_candidate_;
  MotionChains chains_;
  std::vector<MotionAhead> ahead_;
  std::vector<OpenOrder> orders_;
  std::size_t decided_ = 0;
  std::vector<OrderChoice> choices_;
  PassingOrders answer_;
};

}  // namespace armloom
