#include "core/scheduler/ways/detour.h"

#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

// Arm 1 blocks arm 0's shortest path, of 3 s, for about 40 s.
class DetoursByHand : public ::testing::Test, protected Bench {
 protected:
  DetoursByHand() : Bench(2, "earliest_start") {}

  void SetUp() override {
    holds_ = submit(move({1}, 0, 1, 60s), now());
    answer_free(now());
    progressed(holds_, 10ms, now());
    goes_ = submit({.job = JobId{0},
                    .trajectory = way_of(3s),
                    .goals = {{.arm = ArmId{0}, .to = Eigen::VectorXd::Constant(1, 1.0)}}},
                   now());
    answer_plan(3s);
    answer_that_it_waits();
  }

  static TrajectoryPtr way_of(Duration duration) { return move({0}, 0, 1, duration); }
  TimePoint now() { return now_ += 1ms; }
  void heard(const Effect& effect) override {
    if (const auto* plan = std::get_if<PlanMotion>(&effect)) plans_.push_back(*plan);
  }
  void answer_plan(Duration lasts) {
    ASSERT_LT(answered_, plans_.size()) << "nothing was asked";
    const PlanMotion asked = plans_[answered_++];
    step(PlanMade{.step = asked.step, .question = asked.number, .trajectory = way_of(lasts)},
         now());
  }
  // Answers that the shortest path meets arm 1 from 1 to 2 s, until arm 1's motion has reached 40
  // s.
  void answer_that_it_waits() {
    answer_regions(now(),
                   {{only_step(goes_), only_step(holds_), {region(ProgressBox{1s, 2s, 0s, 40s})}}});
  }
  // Offers free paths of these durations. The scheduler does not check paths that arrive later than
  // the best one known.
  void offer(std::vector<Duration> ways) {
    for (const Duration lasts : ways) {
      answer_plan(lasts);
      if (HasFatalFailure()) return;
      if (question) answer_free(now());
    }
  }
  [[nodiscard]] Duration taken() const { return job(goes_).trajectory->duration(); }
  [[nodiscard]] std::size_t asked_around() const { return plans_.size() - 1; }

  TimePoint now_{};
  JobId holds_{0}, goes_{0};
  std::vector<PlanMotion> plans_;
  std::size_t answered_ = 0;
};

TEST_F(DetoursByHand, EarliestArrivalIsChosen) {
  offer({12s, 8s, 10s, 9s});
  if (question) answer_free(now());  // the chosen path is checked again
  EXPECT_EQ(taken(), 8s);
  EXPECT_EQ(state(goes_), JobState::scheduled);
  EXPECT_EQ(asked_around(), static_cast<std::size_t>(kDetoursMax));
  ASSERT_TRUE(job(goes_).goal->detour);
  EXPECT_TRUE(job(goes_).goal->detour->is_taken);
  EXPECT_GT(job(goes_).goal->detour->saves, 20s);
}

TEST_F(DetoursByHand, PathThatHardlyWaitsEndsTheSearch) {
  offer({12s, 3200ms});
  if (question) answer_free(now());
  EXPECT_EQ(taken(), 3200ms);
  EXPECT_EQ(asked_around(), 2U);
}

// It arrives earlier although it waits.
TEST_F(DetoursByHand, ShortestPathIsKeptIfNoneArrivesEarlier) {
  answer_plan(50s);  // too late in any case: it is not even checked
  for (int i = 1; i < kDetoursMax && answered_ < plans_.size(); ++i) answer_plan(55s);
  while (question) answer_that_it_waits();
  EXPECT_EQ(taken(), 3s);
  EXPECT_EQ(state(goes_), JobState::scheduled);
  EXPECT_FALSE(job(goes_).goal->detour->is_taken);
}

TEST_F(DetoursByHand, EachSearchHasABudget) {
  offer({12s, 11s, 10s, 9s});
  ASSERT_EQ(asked_around(), static_cast<std::size_t>(kDetoursMax));
  for (std::size_t i = 1; i < plans_.size(); ++i) {
    EXPECT_EQ(plans_[i].question.budget, kDetourBudget);
    EXPECT_NE(plans_[i].question.seed, plans_[i - 1].question.seed) << "another path each time";
  }
}

}  // namespace
}  // namespace armloom
