#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/precedence/motion_chains.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// One region of two motions (indices), and who may go first in it.
struct OpenOrder {
  std::size_t a;
  std::size_t b;
  ConflictRegion region;  // of a new one, what still lies ahead
  bool a_may = true;
  bool b_may = true;
  bool prefers_a = true;                               // of two that are as good
  bool a_first = true;                                 // as it is set
  bool at_start = false;                               // the second waits at its start
  bool is_open = false;                                // nobody waits for it yet
  std::array<std::optional<Precedence>, 4> made = {};  // by a_first and at_start; once asked for
};

// Orders that are one: all take the same side, or the other one where `turned`. So do the regions
// on both sides of a rest between two motions of an arm, where the same other one passes.
struct OrderChoice {
  struct Member {
    std::size_t order;
    bool turned;
  };
  std::vector<Member> members;
  std::vector<bool> options = {};  // values of "a goes first" of the first member, preferred first
  bool at_start = false;           // as it is set
};

// Who may pass first in all regions of what is admitted and of candidates: what a search for orders
// begins with, and sets. An order may be turned as long as the one who would have to wait has no
// authority in the region; nobody is made to go back.
class OpenOrders {
 public:
  explicit OpenOrders(const OrderQuestion& question);

  [[nodiscard]] const std::vector<CoordinatedMotion>& motions() const { return motions_; }
  [[nodiscard]] std::size_t first_candidate() const { return first_candidate_; }
  // No other motion of its arms comes before it.
  [[nodiscard]] bool leads(std::size_t motion) const { return chains_.before(motion).empty(); }
  // Those of the past first, `decided` of them.
  [[nodiscard]] const std::vector<OpenOrder>& orders() const { return orders_; }
  [[nodiscard]] std::size_t decided() const { return decided_; }
  // Unless blocked, each has an option, and is set to the first of them.
  [[nodiscard]] std::vector<OrderChoice>& choices() { return choices_; }
  [[nodiscard]] bool blocked() const { return !answer_.blockers.empty(); }

  // `at_start`: who passes second shall not have to stop on its way for it, but waits at its start
  // if it is there.
  void set(OrderChoice& choice, bool value, bool at_start = false);
  // Nobody waits for it in predictions, until it is set.
  void leave_open(const OrderChoice& choice);
  // When somebody would have to wait for this side of it, but goes on; nothing: it holds by itself.
  [[nodiscard]] std::optional<Duration> broken_at(const OrderChoice& choice, bool value,
                                                  const Prediction& prediction);
  // As the orders are set; or of what is admitted alone, as that has been decided.
  [[nodiscard]] Prediction predicted();
  [[nodiscard]] Prediction predicted_before();

  // The answers: as the orders are set; or not, because of these orders, or of a ring of waits.
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
