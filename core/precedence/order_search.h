#pragma once

#include <vector>

#include "core/base/time.h"
#include "core/precedence/open_orders.h"
#include "core/precedence/prediction.h"

namespace armloom {

// The orders that cost least, by branch and bound over predictions. A choice that is left open
// delays nobody, so that what is predicted without it bounds from below what follows with it; the
// first one that the motions then break is decided next, both ways. What nobody breaks need not be
// decided: it is as it comes. (As conflict-based search does with paths: Sharon et al. 2015; over
// the disjunctive graph of job shops: Carlier and Pinson 1989.)
//
// A budget of predictions bounds it; what is best by then counts. Deterministic.
//
// Cost: when the last arm has done its work, what waits behind included, and a share of the sum of
// the arms' ends; and for a motion that is the first of its arms kWeightOfPriority times its end
// for each smaller priority that another one has. So of two that meet alike the urgent one passes
// first, but not at any price. Where work is known to wait behind the motions, the arm that is done
// last is told by it, and the sum counts kWeightOfSumBeforeMore; where there is none, whatever
// comes next will want any arm, and each counts kWeightOfSum.
class OrderSearch {
 public:
  inline static constexpr double kWeightOfSum = 0.25;
  inline static constexpr double kWeightOfSumBeforeMore = 0.1;
  inline static constexpr double kWeightOfPriority = 0.2;
  inline static constexpr std::size_t kPredictionsMax = 300;
  // So many orders are followed in all of them together: a prediction takes as long as there are
  // orders, and of long horizons there are thousands.
  inline static constexpr std::size_t kOrdersFollowedMax = 100'000;
  inline static constexpr std::size_t kPredictionsLeast = 20;

  // `work_behind` by ArmId: of jobs that are not among the motions.
  OrderSearch(OpenOrders& open, const std::vector<Duration>& work_behind);

  [[nodiscard]] static double weight_of_sum(const std::vector<Duration>& work_behind);

  // Sets the choices; returns what is predicted then. Somebody is stuck: no orders were found in
  // which everything comes to its end.
  [[nodiscard]] Prediction run();

 private:
  // One of OrderChoice::options, or none yet; who passes second waits on its way or at its start.
  struct Side {
    enum : signed char { open, first, other } side = open;
    bool at_start = false;
  };
  struct Node {
    std::vector<Side> sides;  // by choice
    Prediction prediction;
    double cost;         // s
    std::size_t number;  // in order of making
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
  std::vector<double> urgency_;  // by motion: smaller priorities, while it is the first of its arms
  std::vector<Node> waiting_;    // a heap
  std::optional<Node> best_;
  std::size_t made_ = 0;
  std::size_t made_max_;
};

}  // namespace armloom
