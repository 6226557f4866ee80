#pragma once

#include <vector>

#include "core/base/time.h"
#include "core/precedence/open_orders.h"
#include "core/precedence/prediction.h"

namespace armloom {

// Finds the orders with the least cost, by branch and bound over predictions. Bound: undecided
// orders impose no waits, so the predicted cost is a lower bound. Branching: the undecided order
// that the prediction violates first is decided in both ways. Orders that are not violated need no
// decision. (Similar to conflict-based search for paths, Sharon et al. 2015. The graph is the
// disjunctive graph of job shops, Carlier and Pinson 1989.)
//
// A budget of predictions limits the search, which then returns the best orders found.
// Deterministic.
//
// The cost is the sum of
// - the time at which the last arm has done its work, including work_behind,
// - the sum of the arms' ends, times weight_of_sum(), and
// - for each motion that is the first of its arms, its end, times kWeightOfPriority, times the
//   number of smaller priorities among the motions. So of two equal motions the urgent one passes
//   first, but not at any price. The weight of the sum is kWeightOfSumBeforeMore if there is work
//   behind the motions, because this shows which arm finishes last. Otherwise the next job may need
//   any arm, and the weight is the larger kWeightOfSum.
class OrderSearch {
 public:
  inline static constexpr double kWeightOfSum = 0.25;
  inline static constexpr double kWeightOfSumBeforeMore = 0.1;
  inline static constexpr double kWeightOfPriority = 0.2;
  inline static constexpr std::size_t kPredictionsMax = 300;
  // Largest number of predictions times orders in a search. A prediction takes time proportional to
  // the number of orders, and long horizons have thousands of them.
  inline static constexpr std::size_t kOrdersFollowedMax = 100'000;
  inline static constexpr std::size_t kPredictionsLeast = 20;

  // `work_behind`: duration of the jobs that are not among the motions, by ArmId.
  OrderSearch(OpenOrders& open, const std::vector<Duration>& work_behind);

  [[nodiscard]] static double weight_of_sum(const std::vector<Duration>& work_behind);

  // Sets the choices and returns the prediction with them. If its `stuck` is not empty, the search
  // found no orders with which all motions reach their ends.
  [[nodiscard]] Prediction run();

 private:
  // The state of a choice: open, or one of OrderChoice::options. With `at_start`, the second motion
  // waits at its start, else on its path.
  struct Side {
    enum : signed char { open, first, other } side = open;
    bool at_start = false;
  };
  struct Node {
    std::vector<Side> sides;  // by choice
    Prediction prediction;
    double cost;         // s
    std::size_t number;  // order of creation
  };

  [[nodiscard]] static bool is_later(const Node& a, const Node& b);
  [[nodiscard]] std::vector<bool> motions_concerned() const;
  [[nodiscard]] double cost_of(const Prediction& prediction) const;
  [[nodiscard]] bool is_better(double cost) const;
  [[nodiscard]] Node made(std::vector<Side> sides);
  [[nodiscard]] Node cheaper_way(const Node& node, std::size_t choice, bool first);
  void wait_where_it_is_cheaper();
  [[nodiscard]] std::optional<std::size_t> first_broken(const Node& node);
  void dive(Node node);
  void note(const Node& node);
  void set(const std::vector<Side>& sides);

  OpenOrders& open_;
  const std::vector<Duration>& work_behind_;
  double weight_of_sum_;
  std::vector<double> urgency_;  // by motion: smaller priorities, if it is the first of its arms
  std::vector<Node> waiting_;    // a heap
  std::optional<Node> best_;
  std::size_t made_ = 0;
  std::size_t made_max_;
};

}  // namespace armloom
