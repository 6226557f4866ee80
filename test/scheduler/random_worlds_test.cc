// Whole workloads without geometry, under every policy: arms that share places by a table, are
// late, slow and stall; jobs that are canceled, arms that are stopped, scenes that change. What has
// to hold after every step is claimed by IdealArms.
#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <set>

#include "test/scenarios/seeds.h"
#include "test/scheduler/ideal_arms.h"

namespace armloom {
namespace {

struct Disturbances {
  bool delays = false;
  bool pauses = false;  // all arms are stopped, and resumed
  bool stops = false;   // single ones are
  bool cancels = false;
  bool scenes = false;
  bool parks = false;
};

std::string waits_text(const Wait& wait) {
  return std::string(", waits for ") + to_string(wait.kind) +
         (wait.job ? " " + std::to_string(wait.job->value()) : "") +
         (wait.arm ? " of arm " + std::to_string(wait.arm->value()) : "");
}

class World {
 public:
  World(std::uint64_t seed, const std::string& policy, Disturbances disturbances)
      : random_(seed),
        disturbances_(disturbances),
        arms_(2 + random_() % 3),
        bench_(
            cell(), std::move(*make_policy(policy, *cell())), Crossings(table()),
            [this](JobId) { return habits(); }, seed) {}

  void run() {
    const auto count = 4 + random_() % 12;
    const bool at_once = random_() % 2 == 0;
    for (std::size_t i = 0; i < count; ++i) {
      submit();
      disturb();
      if (!at_once) bench_.run_until(bench_.now() + up_to(3s));
    }
    for (int i = 0; i < 6; ++i) {
      disturb();
      bench_.run_until(bench_.now() + up_to(10s));
    }
    resume();
    if (disturbances_.scenes) change_scene({});
    bench_.run();
  }

  IdealArms& bench() { return bench_; }
  std::vector<JobId> jobs;

 private:
  CellPtr cell() {
    if (cell_) return cell_;
    auto made = std::make_shared<Cell>(
        *(disturbances_.parks ? one_joint_arms_that_park(arms_) : one_joint_arms(arms_)));
    made->execution.duration_margin = 1h;  // stalls are none of the scheduler's business here
    made->execution.start_tolerance_rad = 1e-7;
    return cell_ = made;
  }
  double place() { return 0.01 * static_cast<double>(random_() % 101); }
  Duration up_to(Duration most) {
    return Duration(
        static_cast<Duration::rep>(random_() % static_cast<std::uint64_t>(most.count())));
  }

  // Of each pair of arms some places; both at home, at 0, they are free.
  std::vector<Crossing> table() {
    std::vector<Crossing> table;
    for (std::uint32_t a = 0; a < arms_; ++a) {
      for (std::uint32_t b = a + 1; b < arms_; ++b) {
        for (auto n = random_() % 4; n > 0; --n) {
          const double size_a = 0.02 + 0.2 * place(), size_b = 0.02 + 0.2 * place();
          const double from_a = place() - 0.095, from_b = place() - 0.095;  // no place on an edge
          if (from_a <= 0.0 && from_b <= 0.0) continue;
          table.push_back({ArmId{a}, from_a, from_a + size_a, ArmId{b}, from_b, from_b + size_b});
        }
      }
    }
    return table;
  }

  Habits habits() {
    Habits habits{.brakes_for = up_to(200ms)};
    if (!disturbances_.delays) return habits;
    if (random_() % 2 == 0) habits.starts_late = up_to(10s);
    if (random_() % 2 == 0) habits.speed = 0.1 + 0.9 * place();
    habits.feedback_age = up_to(100ms);
    if (random_() % 4 == 0) {
      habits.stalls_at = up_to(2s);
      habits.stalls_for = up_to(30s);
    }
    return habits;
  }

  // One that finds its way when all that are accepted have ended: done in turn, all can be done.
  void submit() {
    const Configuration rest = bench_.scheduler.predicted_rest();
    for (int tries = 0; tries < 30; ++tries) {
      std::vector<std::uint32_t> arms{static_cast<std::uint32_t>(random_() % arms_)};
      const auto second = static_cast<std::uint32_t>(random_() % arms_);
      if (random_() % 6 == 0 && second > arms[0]) arms.push_back(second);
      std::vector<double> from, to;
      for (const std::uint32_t arm : arms) {
        from.push_back(rest[arm]);
        to.push_back(random_() % 4 == 0 ? 0.0 : place());
      }
      if (from == to) continue;
      const auto motion = move(arms, from, to, 500ms + up_to(4s));
      if (!bench_.crossings.free_beside(*motion, rest)) continue;
      Submit job{JobId{0}, motion, static_cast<int>(random_() % 3), 1'000'000s};
      if (disturbances_.cancels) job.backlog_timeout = 20s + up_to(100s);
      const auto active = bench_.scheduler.active();
      if (!active.empty() && random_() % 5 == 0) {
        job.after.push_back(active[random_() % active.size()]);
      }
      jobs.push_back(bench_.submit(std::move(job)));
      return;
    }
  }

  void disturb() {
    const auto dice = random_() % 8;
    const ArmId arm{static_cast<std::uint32_t>(random_() % arms_)};
    const bool stops = disturbances_.stops || disturbances_.pauses;
    if (stops && dice == 0) stop(disturbances_.pauses ? all() : std::vector{arm});
    if (stops && dice < 3 && dice > 0) resume();
    const auto active = bench_.scheduler.active();
    if (disturbances_.cancels && dice == 3 && !active.empty()) {
      bench_.input(Cancel{active[random_() % active.size()]});
    }
    if (disturbances_.scenes && dice == 4) {
      const double from = place() + 0.005;
      change_scene({{arm, from, from + 0.1 * place()}});
    }
  }
  std::vector<ArmId> all() const {
    std::vector<ArmId> arms;
    for (std::uint32_t arm = 0; arm < arms_; ++arm) arms.emplace_back(arm);
    return arms;
  }
  void stop(const std::vector<ArmId>& arms) {
    bench_.input(Stop{arms, "operator"});
    stopped_.insert(arms.begin(), arms.end());
  }
  void resume() {
    bench_.input(Resume{{stopped_.begin(), stopped_.end()}});
    stopped_.clear();
  }
  void change_scene(std::vector<Object> objects) {
    bench_.crossings.put(std::move(objects));
    bench_.input(SceneChanged{});
  }

  std::mt19937_64 random_;
  Disturbances disturbances_;
  std::size_t arms_;
  CellPtr cell_;
  IdealArms bench_;
  std::set<ArmId> stopped_;
};

class Worlds : public ::testing::TestWithParam<std::string> {
 protected:
  static bool is_timed() { return GetParam() == "timed_discrete"; }

  // How many jobs have ended in each way, over all seeds.
  std::map<JobState, int> run(std::uint64_t usual, Disturbances disturbances, bool all_succeed) {
    std::map<JobState, int> ended;
    for (std::uint64_t seed = 1; seed <= seed_count(usual); ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      World world(seed, GetParam(), disturbances);
      world.run();
      IdealArms& bench = world.bench();
      for (const JobId job : world.jobs) {
        const Job& at_end = bench.job(job);
        ++ended[at_end.state()];
        EXPECT_TRUE(is_terminal(at_end.state()))
            << "job " << job.value() << " is " << to_string(at_end.state())
            << (at_end.times.started_at ? ", has begun" : "")
            << (at_end.waits_on.empty() ? "" : waits_text(at_end.waits_on.front()));
        EXPECT_TRUE(!all_succeed || at_end.state() == JobState::succeeded)
            << "job " << job.value() << " is " << to_string(at_end.state()) << ": " << at_end.detail();
        EXPECT_EQ(bench.terminal_events[job], 1);
        EXPECT_GE(bench.times_dispatched(job), bench.times_released(job));
        EXPECT_EQ(bench.times_dispatched(job) > 0, bench.times_released(job) > 0);
      }
      if (HasFailure()) break;
    }
    return ended;
  }
};
INSTANTIATE_TEST_SUITE_P(Policies, Worlds, ::testing::ValuesIn(policy_names()),
                         [](const auto& policy) { return policy.param; });

TEST_P(Worlds, WhatCanBeDoneInTurnIsDone) {
  EXPECT_GT(run(200, {}, true)[JobState::succeeded], 1000);
}

TEST_P(Worlds, WhatCanBeDoneInTurnIsDoneHoweverLateArmsAre) {
  EXPECT_GT(run(200, {.delays = true}, true)[JobState::succeeded], 1000);
}

// timed_discrete promises it for times that are kept.
TEST_P(Worlds, WhatIsStoppedGoesOn) {
  EXPECT_GT(run(200, {.pauses = true}, !is_timed())[JobState::succeeded], 1000);
}

TEST_P(Worlds, WhatIsStoppedLateGoesOn) {
  EXPECT_GT(run(200, {.delays = true, .pauses = true}, !is_timed())[JobState::succeeded], 1000);
}

TEST_P(Worlds, WhateverIsCanceledEveryJobEndsOnce) {
  auto ended = run(200, {.delays = true, .stops = true, .cancels = true}, false);
  EXPECT_GT(ended[JobState::canceled], 50);
}

TEST_P(Worlds, OnScenesThatChangeEveryJobEndsOnce) {
  auto ended = run(200, {.delays = true, .stops = true, .cancels = true, .scenes = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

TEST_P(Worlds, WhereArmsGoAsideEveryJobEndsOnce) {
  auto ended = run(200, {.delays = true, .cancels = true, .parks = true}, false);
  EXPECT_GT(ended[JobState::succeeded], 500);
}

}  // namespace
}  // namespace armloom
