#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/precedence/motion_chains.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// A conflict region of two motions A and B (`a`, `b`: indices into motions()), and which of them
// may pass first.
struct OpenOrder {
  std::size_t a;
  std::size_t b;
  ConflictRegion region;  // new orders: without boxes that a motion has passed
  bool a_may = true;
  bool b_may = true;
  bool prefers_a = true;
  bool a_first = true;                                 // the present setting
  bool at_start = false;                               // the second motion waits at its start
  bool is_open = false;                                // undecided: delays no motion in predictions
  std::array<std::optional<Precedence>, 4> made = {};  // cache, by a_first and at_start
};

// Orders that are decided together, because their regions are one across a rest: with one value of
// "a first", or with the opposite value for members that are `turned`.
struct OrderChoice {
  struct Member {
    std::size_t order;
    bool turned;
  };
  std::vector<Member> members;
  // Possible values of "a first" for the first member; the preferred value is first.
  std::vector<bool> options = {};
  bool at_start = false;  // the present setting
};

// The open decisions in all regions of admitted motions and candidates. No motion is made to go
// back: an order can be reversed only while the motion that would then have to wait has no
// authority in the region.
class OpenOrders {
 public:
  explicit OpenOrders(const OrderQuestion& question);

  [[nodiscard]] const std::vector<CoordinatedMotion>& motions() const { return motions_; }
  [[nodiscard]] std::size_t first_candidate() const { return first_candidate_; }
  // Returns true if no other motion of its arms precedes it.
  [[nodiscard]] bool leads(std::size_t motion) const { return chains_.before(motion).empty(); }
  // Returns all orders. The first decided() of them exist already between admitted motions.
  [[nodiscard]] const std::vector<OpenOrder>& orders() const { return orders_; }
  [[nodiscard]] std::size_t decided() const { return decided_; }
  // Returns the decisions to be made. Unless blocked(), each has an option, and the first option is
  // set.
  [[nodiscard]] std::vector<OrderChoice>& choices() { return choices_; }
  [[nodiscard]] bool blocked() const { return !answer_.blockers.empty(); }

  // Sets the choice. With `at_start`, the second motion waits at its start instead of on its path,
  // if it is still there.
  void set(OrderChoice& choice, bool value, bool at_start = false);
  // Makes the choice delay no motion in predictions.
  void leave_open(const OrderChoice& choice);
  // Returns when the prediction first violates the choice with this value: when a second motion
  // enters a region before the first motion has left it. nullopt if that never happens.
  [[nodiscard]] std::optional<Duration> broken_at(const OrderChoice& choice, bool value,
                                                  const Prediction& prediction);
  // Predict all motions with the orders as set, or only the admitted motions with their existing
  // orders.
  [[nodiscard]] Prediction predicted();
  [[nodiscard]] Prediction predicted_before();

  // Return the answer to the question: the candidates are admitted with the orders as set; they are
  // refused because of these orders; or they would be stuck in a cycle of waits.
  [[nodiscard]] PassingOrders admitted(Prediction prediction);
  [[nodiscard]] PassingOrders refused(const std::vector<std::size_t>& because);
  [[nodiscard]] PassingOrders stuck(const Prediction& prediction);

 private:
  [[nodiscard]] std::optional<std::size_t> index_of(StepId step) const;
  void add(const PairRegions& pair);
  void add_decided(const Precedence& precedence);
  void add(std::size_t a, std::size_t b, const ConflictRegion& region);
  [[nodiscard]] bool reaches(std::size_t motion, Duration from, std::size_t other) const;
  [[nodiscard]] bool rests_at(std::size_t motion, Duration to, std::size_t other) const;
  [[nodiscard]] bool may_pass_second(std::size_t second, std::size_t first,
                                     const ProgressBox& box) const;
  void note_in_the_way(std::size_t motion);
  [[nodiscard]] std::vector<std::vector<OrderChoice::Member>> joined_at_rests() const;
  void collect_choices();
  [[nodiscard]] bool allowed(const OrderChoice& choice, bool a_first) const;
  [[nodiscard]] const Precedence& precedence(OpenOrder& order, bool a_first, bool at_start);
  [[nodiscard]] std::vector<Dependency> dependencies(std::size_t orders);
  void report(std::size_t order);

  std::vector<CoordinatedMotion> motions_;
  std::size_t first_candidate_;
  MotionChains chains_;
  HeldAt held_at_;
  std::vector<OpenOrder> orders_;
  std::size_t decided_ = 0;
  std::vector<OrderChoice> choices_;
  PassingOrders answer_;
};

}  // namespace armloom
