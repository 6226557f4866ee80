#include <gmock/gmock.h>

#include "test/scheduler/ideal_arms.h"

namespace armloom {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr Duration kAtMost = 250ms;  // largest difference
constexpr Duration kMoves = 10s;

// The paths of the two arms cross in their middle.
const Crossing kCross{ArmId{0}, 0.4, 0.6, ArmId{1}, 0.4, 0.6};

CellPtr cell_with(std::size_t arms, int horizon_steps) {
  auto cell = std::make_shared<Cell>(*one_joint_arms(arms));
  cell->scheduling.horizon_steps = horizon_steps;
  return cell;
}

struct Timeline : ::testing::Test {
  void start(const char* policy, int horizon_steps, std::map<JobId, Habits> habits = {},
             std::vector<Crossing> crossings = {kCross}) {
    const CellPtr cell = cell_with(2, horizon_steps);
    arms = std::make_unique<IdealArms>(cell, std::move(*make_policy(policy, *cell)),
                                       Crossings(std::move(crossings)), [habits](JobId job) {
                                         const auto own = habits.find(job);
                                         return own == habits.end() ? Habits{} : own->second;
                                       });
  }
  JobId submit(std::uint32_t arm, double from, double to, Duration duration = kMoves) {
    return arms->submit({JobId{0}, move({arm}, from, to, duration), 0, 600s});
  }
  PredictedTimeline told() const { return arms->scheduler.timeline(arms->now()); }
  PredictedLeg leg(JobId job) const {
    const auto legs = told().legs;
    const auto found = std::ranges::find(legs, only_step(job), &PredictedLeg::step);
    if (found == legs.end()) throw std::runtime_error("no such leg");
    return *found;
  }

  std::unique_ptr<IdealArms> arms;
};

void expect_near(TimePoint told, TimePoint came) {
  EXPECT_LE(std::chrono::abs(told - came), kAtMost)
      << to_seconds(told.time_since_epoch()) << " was told, " << to_seconds(came.time_since_epoch())
      << " it was";
}

TEST_F(Timeline, PredictsWhenAWaitingMotionContinuesAndItsBlocker) {
  for (const char* policy : {"coordinated", "earliest_start"}) {
    SCOPED_TRACE(policy);
    start(policy, 1);
    const std::array jobs{submit(0, 0, 1), submit(1, 0, 1)};
    arms->run_until(at(1s));
    ASSERT_THAT(told().legs, SizeIs(2));
    const std::array legs{leg(jobs[0]), leg(jobs[1])};
    const std::size_t second = legs[0].pauses.empty() ? 1 : 0;
    EXPECT_THAT(legs[1 - second].pauses, IsEmpty());
    ASSERT_THAT(legs[second].pauses, SizeIs(1));
    const ArmId second_arm{static_cast<std::uint32_t>(second)};
    const PredictedPause& pause = legs[second].pauses.front();
    EXPECT_EQ(pause.waits_on->kind, Wait::Kind::job);
    EXPECT_EQ(pause.waits_on->job, jobs[1 - second]);
    EXPECT_LT(place_of(*arms->job(jobs[second]).trajectory, second_arm, pause.at), 0.4 + 1e-3)
        << "short of where they cross";
    arms->run_until(*pause.to - kPauseLoss - kAtMost);
    EXPECT_LE(arms->job(jobs[second]).progress, pause.at);
    arms->run();
    for (const std::size_t j : {0U, 1U}) {
      expect_near(*legs[j].ends, *arms->job(jobs[j]).ended_at() +
                                     (j == second && pause.at > 0s ? kPauseLoss : Duration{}));
      expect_near(*legs[j].starts, *arms->job(jobs[j]).times.started_at);
    }
  }
}

TEST_F(Timeline, HasTheMotionsWithinThePolicysHorizon) {
  start("coordinated", 3);
  std::vector<JobId> jobs;
  for (int i = 0; i < 5; ++i) jobs.push_back(submit(0, i % 2, 1 - i % 2, 2s));
  arms->run_until(at(1s));
  const PredictedTimeline timeline = told();
  ASSERT_THAT(timeline.legs, SizeIs(3));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(timeline.legs[i].step, only_step(jobs[i]));
    EXPECT_THAT(timeline.legs[i].pauses, IsEmpty()) << "waiting for its turn is not a pause";
    if (i == 0) continue;
    EXPECT_EQ(timeline.legs[i].starts, timeline.legs[i - 1].ends);
  }
  arms->run();
  expect_near(*timeline.legs[2].ends, *arms->job(jobs[2]).ended_at());
}

TEST_F(Timeline, PredictsNoPausesUnderTimedDiscrete) {
  start("timed_discrete", 1, {}, {});
  const JobId job = submit(0, 0, 1);
  arms->run_until(at(2s));
  EXPECT_THAT(leg(job).pauses, IsEmpty());
  expect_near(*leg(job).ends, TimePoint(kMoves));
}

TEST_F(Timeline, StallIsExpectedToLastAsLongAgain) {
  start("certified", 1, {{JobId{1}, {.stalls_at = 2s, .stalls_for = 20s}}});
  const JobId job = submit(0, 0, 1);
  arms->run_until(at(8s));  // it has stalled for 6 s
  const PredictedLeg leg = this->leg(job);
  ASSERT_THAT(leg.pauses, SizeIs(1));
  EXPECT_EQ(leg.pauses[0].waits_on, std::nullopt);
  expect_near(*leg.pauses[0].to, at(14s));
  expect_near(*leg.ends, at(22s));
}

// A stop lasts until an operator resumes the arm, at an unknown time.
TEST_F(Timeline, StoppedMotionAndItsDependentsHaveNoPredictedEnd) {
  start("coordinated", 2);
  const JobId first = submit(0, 0, 1), next = submit(0, 1, 0);
  arms->run_until(at(4s));
  const JobId other = submit(1, 0, 1);
  arms->run_until(at(5s));  // the first arm is at the crossing
  ASSERT_TRUE(leg(other).ends);
  arms->input(Stop{{ArmId{0}}, "somebody came"});
  arms->run_until(at(8s));
  const PredictedLeg leg = this->leg(first);
  EXPECT_EQ(leg.ends, std::nullopt);
  ASSERT_THAT(leg.pauses, SizeIs(1));
  EXPECT_EQ(leg.pauses[0].to, std::nullopt);
  EXPECT_EQ(leg.pauses[0].waits_on->kind, Wait::Kind::stop);
  EXPECT_EQ(leg.pauses[0].waits_on->detail, "somebody came");
  for (const JobId waits : {next, other}) {
    const PredictedLeg after = this->leg(waits);
    EXPECT_EQ(after.ends, std::nullopt) << waits.value();
    ASSERT_THAT(after.pauses, SizeIs(1));
    EXPECT_EQ(after.pauses[0].waits_on->job, first);
  }
  arms->input(Resume{{ArmId{0}}});
  EXPECT_TRUE(this->leg(first).ends && this->leg(next).ends && this->leg(other).ends);
}

TEST_F(Timeline, MotionThatAnObjectBlocksOnItsPathHasNoPredictedEnd) {
  start("coordinated", 1);
  const JobId job = submit(0, 0, 1);
  arms->run_until(at(4s));
  ASSERT_TRUE(leg(job).ends);
  arms->crossings.put({{ArmId{0}, 0.8, 0.9}});
  arms->input(SceneChanged{{ArmId{0}}});
  arms->run_until(at(8s));
  const PredictedLeg blocked = leg(job);
  EXPECT_EQ(blocked.ends, std::nullopt);
  ASSERT_FALSE(blocked.pauses.empty());
  EXPECT_EQ(blocked.pauses.back().to, std::nullopt);
  ASSERT_TRUE(blocked.pauses.back().waits_on);
  EXPECT_EQ(blocked.pauses.back().waits_on->kind, Wait::Kind::object);
  arms->crossings.put({});
  arms->input(SceneChanged{{ArmId{0}}});
  arms->run_until(at(8100ms));
  EXPECT_TRUE(leg(job).ends);
}

TEST_F(Timeline, PermanentlyBlockedMotionHasNoPredictedEnd) {
  start("coordinated", 2);
  const JobId first = submit(0, 0, 1);
  arms->run_until(at(4s));
  const JobId second = submit(1, 0, 1), follows = submit(1, 1, 0);
  arms->run_until(at(5200ms));  // the first arm is at the crossing
  ASSERT_TRUE(leg(second).ends);
  arms->input(Cancel{first});
  arms->run_until(at(6s));
  const PredictedLeg held = leg(second);
  EXPECT_EQ(held.ends, std::nullopt);
  ASSERT_FALSE(held.pauses.empty());
  EXPECT_EQ(held.pauses.back().to, std::nullopt);
  EXPECT_EQ(held.pauses.back().waits_on->kind, Wait::Kind::arm);
  EXPECT_EQ(held.pauses.back().waits_on->arm, ArmId{0});
  const PredictedLeg behind = leg(follows);
  EXPECT_EQ(behind.starts, std::nullopt);
  EXPECT_EQ(behind.ends, std::nullopt);
  ASSERT_THAT(behind.pauses, SizeIs(1));
  EXPECT_EQ(behind.pauses[0].waits_on->kind, Wait::Kind::predecessor);
  EXPECT_EQ(behind.pauses[0].waits_on->job, second);
}

}  // namespace
}  // namespace armloom
