#include "core/precedence/order_search.h"

#include <gtest/gtest.h>

#include <random>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

// Random motions in two to four arm queues, and regions between queues.
class RandomOrders {
 public:
  explicit RandomOrders(std::uint64_t seed) : random_(seed) {
    lanes_ = 2 + static_cast<std::uint32_t>(random_() % 3);
    for (std::uint64_t leg = 0; leg < 2; ++leg) {
      for (std::uint32_t arm = 0; arm < lanes_; ++arm) {
        const StepId step{JobId{motions_.size() + 1}};
        motions_.push_back({.step = step, .arms = {ArmId{arm}}, .duration = 1s + up_to(3s)});
      }
    }
    for (const CoordinatedMotion& a : motions_) {
      for (const CoordinatedMotion& b : motions_) {
        if (b.step < a.step && a.arms != b.arms && random_() % 3 == 0) meet(a, b);
      }
    }
    work_.resize(lanes_);
    if (random_() % 2 == 0) {  // otherwise nothing waits behind them
      for (Duration& work : work_) work = up_to(4s);
    }
  }
  [[nodiscard]] OpenOrders open() const {
    return OpenOrders({nobody_, none_, {}, motions_, regions_, work_});
  }
  [[nodiscard]] const std::vector<Duration>& work() const { return work_; }

  // The cost of OrderSearch, for equal priorities.
  [[nodiscard]] double cost_of(const Prediction& prediction) const {
    std::vector<double> ends(lanes_);
    for (std::size_t m = 0; m < motions_.size(); ++m) {
      double& end = ends[motions_[m].arms.front().index()];
      end = std::max(end, to_seconds(prediction.ends[m]));
    }
    double last = 0.0, sum = 0.0;
    for (std::size_t arm = 0; arm < ends.size(); ++arm) {
      last = std::max(last, ends[arm] + to_seconds(work_[arm]));
      sum += ends[arm];
    }
    return last + OrderSearch::weight_of_sum(work_) * sum;
  }

 private:
  Duration up_to(Duration most) {
    return Duration(
        static_cast<Duration::rep>(random_() % static_cast<std::uint64_t>(most.count())));
  }
  void meet(const CoordinatedMotion& a, const CoordinatedMotion& b) {
    const Duration from_a = 100ms + up_to(700ms), from_b = 100ms + up_to(700ms);
    regions_.push_back(
        {a.step, b.step, {region(ProgressBox{from_a, from_a + 100ms, from_b, from_b + 100ms})}});
  }

  std::mt19937_64 random_;
  std::uint32_t lanes_;
  std::vector<CoordinatedMotion> nobody_;
  std::vector<Precedence> none_;
  std::vector<CoordinatedMotion> motions_;
  std::vector<PairRegions> regions_;
  std::vector<Duration> work_;
};

TEST(OrderSearch, MatchesExhaustiveSearch) {
  std::size_t compared = 0, better_than_first = 0;
  for (std::uint64_t seed = 1; seed <= 2200; ++seed) {
    const RandomOrders random(seed);
    OpenOrders open = random.open();
    std::vector<OrderChoice*> free;
    for (OrderChoice& choice : open.choices()) {
      if (choice.options.size() > 1) free.push_back(&choice);
    }
    if (open.blocked() || free.empty() || free.size() > 9) continue;
    std::optional<double> cheapest;
    double first = 0.0;
    for (std::size_t which = 0; which < std::size_t{1} << free.size(); ++which) {
      for (std::size_t i = 0; i < free.size(); ++i) {
        open.set(*free[i], free[i]->options[which >> i & 1U]);
      }
      const Prediction prediction = open.predicted();
      if (!prediction.stuck.empty()) continue;
      const double cost = random.cost_of(prediction);
      if (which == 0) first = cost;
      cheapest = std::min(cheapest.value_or(cost), cost);
    }
    OpenOrders searched = random.open();
    const Prediction found = OrderSearch(searched, random.work()).run();
    ASSERT_EQ(found.stuck.empty(), cheapest.has_value()) << "seed " << seed;
    if (!cheapest) continue;
    ++compared;
    EXPECT_LE(random.cost_of(found), *cheapest + 2e-3) << "seed " << seed;
    EXPECT_NEAR(random.cost_of(searched.predicted()), random.cost_of(found), 1e-9);
    if (random.cost_of(found) < first - 0.1) ++better_than_first;
  }
  EXPECT_GT(compared, 150u);
  EXPECT_GT(better_than_first, 50u);
}

// Two arms meet in one region, and the second waits until the first has left. Returns true if the
// urgent motion passes first.
bool urgent_passes_first(Duration urgent_from, Duration urgent_to, Duration other_from,
                         Duration other_to) {
  const std::vector<CoordinatedMotion> motions = {
      {.step = StepId{JobId{1}}, .arms = {ArmId(0)}, .duration = 10s, .priority = 1},
      {.step = StepId{JobId{2}}, .arms = {ArmId(1)}, .duration = 10s}};
  const std::vector<CoordinatedMotion> nobody;
  const std::vector<Precedence> none;
  const std::vector<PairRegions> regions = {
      {StepId{JobId{1}},
       StepId{JobId{2}},
       {region(ProgressBox{urgent_from, urgent_to, other_from, other_to})}}};
  const std::vector<Duration> work(2);
  OpenOrders open({nobody, none, {}, motions, regions, work});
  EXPECT_TRUE(OrderSearch(open, work).run().stuck.empty());
  return open.orders().front().a_first;
}

TEST(OrderSearch, UrgentMotionPassesFirstUnlessTooCostly) {
  EXPECT_TRUE(urgent_passes_first(4s, 6s, 4s, 6s)) << "equal times";
  EXPECT_TRUE(urgent_passes_first(4100ms, 6100ms, 4s, 6s)) << "although the other arrives earlier";
  EXPECT_FALSE(urgent_passes_first(4s, 8s, 4s, 5s)) << "4 s for the other against 1 s for itself";
}

// Passing second, the short motion would end 2.9 s later, the long motion 0.4 s later.
bool short_one_passes_first(Duration work_behind_long) {
  const std::vector<CoordinatedMotion> motions = {
      {.step = StepId{JobId{1}}, .arms = {ArmId(0)}, .duration = 1500ms},
      {.step = StepId{JobId{2}}, .arms = {ArmId(1)}, .duration = 10s}};
  const std::vector<CoordinatedMotion> nobody;
  const std::vector<Precedence> none;
  const std::vector<PairRegions> regions = {
      {StepId{JobId{1}}, StepId{JobId{2}}, {region(ProgressBox{500ms, 1s, 600ms, 3400ms})}}};
  const std::vector<Duration> work{0s, work_behind_long};
  OpenOrders open({nobody, none, {}, motions, regions, work});
  EXPECT_TRUE(OrderSearch(open, work).run().stuck.empty());
  return open.orders().front().a_first;
}

TEST(OrderSearch, WeighsWorkThatWaitsBehindAMotion) {
  EXPECT_TRUE(short_one_passes_first(0s));
  EXPECT_FALSE(short_one_passes_first(5s));
}

}  // namespace
}  // namespace armloom
