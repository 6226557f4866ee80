// The speed override of the cell and of each arm changes at random, down to 0.
// ARMLOOM_SEEDS=500 runs more.
#include <gtest/gtest.h>

#include "test/scenarios/random_faults.h"
#include "test/scenarios/seeds.h"
#include "test/scenarios/star.h"

namespace armloom {
namespace {

constexpr std::uint64_t kSeeds = 12;

double any_share(Random& random) {
  return std::vector{0.0, 0.001, 0.05, 0.1, 0.5, 0.9, 1.0, 1.0}[random.index(8)];
}

// A star with jobs of one and two arms.
struct StarRun {
  StarRun(std::uint64_t seed, const std::string& policy)
      : random(seed), arms(2 + seed % 3), closest(arms) {
    CellDescription description = star(arms);
    description.scheduling.backlog_timeout = 30s;  // short, beside jobs that are paused for minutes
    description.scheduling.aging = 20s;
    cell = *build_cell(description);
    simulation = std::move(*Simulation::create(cell, ExecutiveOptions{.policy = policy}, closest));
    simulation->tick();
  }
  Executive& executive() const { return simulation->executive(); }
  void set_any_speed() {
    const std::size_t which = random.index(arms + 1);
    const std::optional<ArmId> arm =
        which == arms ? std::nullopt : std::optional(ArmId{static_cast<std::uint32_t>(which)});
    executive().set_speed(arm, any_share(random));
  }
  void set_full_speed() {
    executive().set_speed(std::nullopt, 1.0);
    for (std::uint32_t arm = 0; arm < arms; ++arm) executive().set_speed(ArmId{arm}, 1.0);
  }
  // Moves one arm, or two in step that pass the crossing one after the other, from side to side.
  void submit() {
    std::vector<std::size_t> moved{random.index(arms)};
    if (arms > 2 && random.chance(0.2)) moved.push_back((moved.front() + 1) % arms);
    JobRequest request{.key = "", .name = "", .trajectory = {}};
    std::vector<double> from, across, to, zero(moved.size(), 0.0);
    const double takes_s = random.uniform(2.4, 5.0);
    for (const std::size_t arm : moved) {
      request.trajectory.joint_names.push_back(name(arm) + "_slide");
      from.push_back(stands[arm]);
      across.push_back(moved.front() == arm ? -stands[arm] : stands[arm]);
      to.push_back(-stands[arm]);
      stands[arm] = to.back();
    }
    request.trajectory.points = {{from, zero, zero, 0.0}, {across, zero, zero, takes_s}};
    if (moved.size() > 1) request.trajectory.points.push_back({to, zero, zero, 2 * takes_s});
    const auto view = executive().submit(std::move(request));
    ASSERT_TRUE(view) << view.error().front().detail;
    keys.push_back(view->key);
  }
  static std::string name(std::size_t arm) { return {static_cast<char>('a' + arm)}; }

  Random random;
  std::size_t arms;
  SmallestDistance closest;
  CellPtr cell;
  std::unique_ptr<Simulation> simulation;
  std::vector<std::string> keys;
  std::vector<double> stands = std::vector<double>(4, -1.0);
};

class RandomSpeed : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Policies, RandomSpeed,
                         ::testing::Values("sequential", "lockstep", "reservation", "certified",
                                           "earliest_start", "coordinated"));

TEST_P(RandomSpeed, KeepsTheClearanceAndEveryJobSucceeds) {
  std::size_t paused = 0;
  for (std::uint64_t seed = 1; seed <= seed_count(kSeeds); ++seed) {
    SCOPED_TRACE(std::string(GetParam()) + ", seed " + std::to_string(seed));
    StarRun run(seed, GetParam());
    for (int i = 0; i < 40; ++i) {
      if (i % 4 == 0) run.submit();
      if (run.random.chance(0.7)) run.set_any_speed();
      run.simulation->run_until(run.simulation->now() + from_seconds(run.random.uniform(0.0, 3.0)));
      for (const JobView& job : run.executive().snapshot(0).jobs) {
        if (job.state != JobState::paused) continue;
        EXPECT_FALSE(job.waits_on.empty()) << job.key << " does not say why it is paused";
        ++paused;
      }
    }
    run.simulation->run_until(run.simulation->now() + 100s);  // with the last override, maybe 0
    run.set_full_speed();
    const TimePoint latest = run.simulation->now() + 10min;
    while (!run.executive().all_ended() && run.simulation->now() < latest) run.simulation->tick();
    DelayedRun outcome;
    outcome.read(run.executive(), run.keys);
    EXPECT_EQ(outcome.succeeded, outcome.jobs) << outcome.first_other;
    EXPECT_EQ(outcome.monitor_stops, 0U);
    EXPECT_EQ(run.executive().figures().guard_refusals, 0U);
    EXPECT_GE(run.closest.smallest_m, 0.99 * run.cell->clearances.clearance_m)
        << "at " << to_seconds(run.closest.when) << " s";
  }
  EXPECT_GT(paused, kSeeds);
}

// While the override does not change, equal instants are compared at the speeds of the arms.
TEST(SpeedUnderTimedDiscrete, KeepsTheClearanceAtConstantOverrides) {
  for (std::uint64_t seed = 1; seed <= seed_count(kSeeds); ++seed) {
    SCOPED_TRACE(seed);
    StarRun run(seed, "timed_discrete");
    for (std::uint32_t arm = 0; arm < run.arms; ++arm) {
      run.executive().set_speed(ArmId{arm}, std::max(0.1, any_share(run.random)));
    }
    for (int i = 0; i < 12; ++i) {
      run.submit();
      run.simulation->run_until(run.simulation->now() + from_seconds(run.random.uniform(0.0, 3.0)));
    }
    const TimePoint latest = run.simulation->now() + 20min;
    while (!run.executive().all_ended() && run.simulation->now() < latest) run.simulation->tick();
    DelayedRun outcome;
    outcome.read(run.executive(), run.keys);
    EXPECT_EQ(outcome.succeeded, outcome.jobs) << outcome.first_other;
    EXPECT_EQ(outcome.monitor_stops, 0U);
    EXPECT_GE(run.closest.smallest_m, 0.9 * run.cell->clearances.clearance_m);
  }
}

TEST(Speed, IsPublishedOnArmsAndQueue) {
  Crossing cell(crossing_description(), "coordinated");
  Executive& executive = cell.simulation->executive();
  executive.set_speed(std::nullopt, 0.5);
  executive.set_speed(ArmId{0}, 0.5);
  cell.run_until(cell.simulation->now() + 10ms);
  const Snapshot now = executive.snapshot(0);
  EXPECT_DOUBLE_EQ(now.queue.speed_override, 0.5);
  EXPECT_DOUBLE_EQ(now.arms[0].speed_override, 0.5);
  EXPECT_DOUBLE_EQ(now.arms[0].effective_speed_override, 0.25);
  EXPECT_DOUBLE_EQ(now.arms[1].speed_override, 1.0);
  EXPECT_DOUBLE_EQ(now.arms[1].effective_speed_override, 0.5);
  std::optional<double> arm, queue;
  for (const Event& event : cell.log.events) {
    const auto* view = std::get_if<ArmView>(&event.body);
    if (view != nullptr && view->name == "x") arm = view->effective_speed_override;
    if (const auto* view_of_queue = std::get_if<QueueView>(&event.body))
      queue = view_of_queue->speed_override;
  }
  EXPECT_EQ(arm, 0.25);
  EXPECT_EQ(queue, 0.5);
}

// A job of two arms goes at the smaller share, and each arm keeps its own share for other jobs.
TEST(Speed, MotionOfTwoArmsGoesAtTheSmallestShare) {
  Crossing cell(crossing_description(), "coordinated");
  Executive& executive = cell.simulation->executive();
  executive.set_speed(ArmId{0}, 0.25);
  JobRequest both{.key = "both", .name = "", .trajectory = {}};
  both.trajectory.joint_names = {"x_slide", "y_slide"};
  both.trajectory.points = {{{-1.0, -1.0}, {0.0, 0.0}, {0.0, 0.0}, 0.0},
                            {{-0.5, -0.5}, {0.0, 0.0}, {0.0, 0.0}, 2.0}};
  cell.submit(both);
  cell.submit(slide("y", -0.5, -1.0, 2.0, "alone"));
  cell.run_to_the_end();
  const auto took_s = [&](const char* key) {
    const JobTimesView times = cell.job(key).times;
    return to_seconds(*times.ended_at - *times.started_at);
  };
  EXPECT_NEAR(took_s("both"), 8.0, 0.3);
  EXPECT_NEAR(took_s("alone"), 2.0, 0.3);
}

TEST(Speed, CheckPredictsTheStartAtTheOverride) {
  Crossing cell(crossing_description(), "earliest_start");
  cell.simulation->executive().set_speed(std::nullopt, 0.1);
  cell.submit(slide("x", -1, 1, 4, "first"));
  cell.run_until(at(1s));
  std::optional<CheckView> check;
  cell.simulation->executive().inquiries().check(
      slide("y", -1, 1, 4), [&](const Result<CheckView>& made) { check = *made; });
  cell.run_until(at(2s));
  ASSERT_TRUE(check && check->earliest_start_s);
  cell.submit(slide("y", -1, 1, 4, "second"));
  cell.run_to_the_end(at(200s));
  const double started_s = to_seconds(*cell.job("second").times.started_at);
  EXPECT_NEAR(started_s, 1.0 + *check->earliest_start_s, 0.5);
  EXPECT_GT(started_s, 3.0);
}

}  // namespace
}  // namespace armloom
