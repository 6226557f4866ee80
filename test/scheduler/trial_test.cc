// Compares the outcome of a Trial with what the scheduler then does with the job, during random
// workloads under every policy. ARMLOOM_SEEDS=100 compares about 8,000 states per policy.
#include "core/scheduler/trial.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "test/scenarios/seeds.h"
#include "test/scheduler/random_world.h"

namespace armloom {
namespace {

constexpr std::uint64_t kSeeds = 20;

std::string text(const std::vector<Wait>& waits) {
  std::string text;
  for (const Wait& wait : waits) {
    text += std::string(text.empty() ? "" : ", ") + to_string(wait.kind) +
            (wait.job ? " of job " + std::to_string(wait.job->value()) : "") +
            (wait.arm ? " of arm " + std::to_string(wait.arm->value()) : "") +
            (wait.detail.empty() ? "" : " (" + wait.detail + ")");
  }
  return text.empty() ? "nothing" : text;
}

// Published state of all existing jobs.
std::string told(const Scheduler& scheduler) {
  std::string text;
  for (const JobId id : scheduler.active()) {
    const Step& step = *scheduler.find(id);
    text += std::to_string(id.value()) + " " + to_string(step.state()) + " " +
            std::to_string(step.progress.count()) + " " + armloom::text(step.waits_on) + "\n";
  }
  return text;
}

struct Seen {
  int states = 0, free_now = 0, free_later = 0, wait = 0, fail = 0;
};

class Look {
 public:
  Look(World& world, Seen& seen) : world_(world), seen_(seen) {}

  void operator()() {
    auto job = draw();
    if (!job || ::testing::Test::HasFailure()) return;
    const Trial::Outcome says = ask(*job);
    const JobId id = world_.submit(std::move(*job));
    for (int answers = 0; answers < Trial::kJudgementsMax; ++answers) {
      settle_ring(id);
      if (is_decided(id) || !bench().answer_now()) break;
    }
    compare(says, bench().job(id));
  }

 private:
  IdealArms& bench() { return world_.bench(); }

  // Runs the step that resolves a deadlock.
  void settle_ring(JobId id) {
    while (!bench().job(id).job->ring.empty() && bench().wake_at &&
           *bench().wake_at <= bench().now() + kAfterRingWasTold) {
      bench().run_until(*bench().wake_at);
    }
  }

  // Draws a job. At two of three draws it begins with an idle arm, if there is one. At one of three
  // draws it may be blocked.
  std::optional<Submit> draw() {
    if (++looks_ % 4 != 0) wait_for_room();
    std::optional<Submit> job;
    for (int tries = 0; tries < 20; ++tries) {
      job = world_.draw(looks_ % 3 == 0);
      if (looks_ % 3 == 1 || (job && is_first(*job))) break;
    }
    return job;
  }
  void wait_for_room() {
    for (int i = 0; i < 40 && bench().scheduler.active().size() > 1; ++i) {
      bench().run_until(bench().now() + 2s);
    }
  }
  bool is_first(const Submit& job) {
    return job.after.empty() && std::ranges::none_of(job.trajectory->arms(), [this](ArmId arm) {
             return std::ranges::any_of(bench().scheduler.active(), [&](JobId id) {
               const auto& arms = bench().job(id).trajectory->arms();
               return std::ranges::find(arms, arm) != arms.end();
             });
           });
  }
  bool is_decided(JobId id) {
    const JobState state = bench().state(id);
    return state != JobState::queued && state != JobState::backlogged;
  }

  Trial::Outcome ask(Submit job) {
    const std::string before = told(bench().scheduler);
    job.job = bench().next_id();
    Trial trial(bench().scheduler, {bench().question}, {job}, job.job, bench().now());
    while (const auto question = trial.next()) trial.answer(bench().crossings.answer(*question));
    EXPECT_EQ(told(bench().scheduler), before) << "the trial is seen";
    return trial.outcome();
  }

  void compare(const Trial::Outcome& says, const Step& step) {
    ++seen_.states;
    const bool is_free = step.state() == JobState::scheduled || step.state() == JobState::running;
    const std::string what = "job " + std::to_string(step.id.job.value()) + " at " +
                             std::to_string(to_seconds(bench().now().time_since_epoch())) +
                             " s, said to wait for " + text(says.waits) + ", is " +
                             to_string(step.state()) + " and waits for " + text(step.waits_on);
    ASSERT_EQ(says.kind == Verdict::Kind::free, is_free) << what;
    if (is_free) {
      ASSERT_EQ(says.starts_in, std::max(Duration{}, *step.times.scheduled_at - bench().now()))
          << what;
      ASSERT_EQ(text(says.waits), text(step.waits_on)) << what;
      ++(*says.starts_in > Duration{} ? seen_.free_later : seen_.free_now);
    } else if (is_terminal(step.state())) {
      ++seen_.fail;
      ASSERT_EQ(says.step->state(), step.state()) << what;
      ASSERT_EQ(says.step->reason(), step.reason()) << what;
    } else {
      ++seen_.wait;
      ASSERT_EQ(text(says.waits), text(step.waits_on)) << what;
    }
  }

  World& world_;
  Seen& seen_;
  int looks_ = 0;
};

class Trials : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, Trials, ::testing::ValuesIn(policy_names()),
                         [](const auto& policy) { return policy.param; });

TEST_P(Trials, OutcomeMatchesTheScheduler) {
  const std::vector<Disturbances> all = {
      {},
      {.delays = true, .pauses = true},
      {.delays = true, .stops = true, .cancels = true},
      {.delays = true, .stops = true, .cancels = true, .scenes = true},
      {.delays = true, .cancels = true, .parks = true},
  };
  Seen seen;
  for (std::uint64_t seed = 1; seed <= seed_count(kSeeds); ++seed) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", disturbances " + std::to_string(i));
      World world(seed, GetParam(), all[i]);
      world.run(Look(world, seen));
      if (HasFailure()) return;
    }
  }
  std::cout << GetParam() << ": " << seen.states << " states: free now " << seen.free_now
            << ", later " << seen.free_later << ", waits " << seen.wait << ", fails " << seen.fail
            << "\n";
  EXPECT_GT(seen.states, static_cast<int>(50 * seed_count(kSeeds)));
  EXPECT_GT(6 * (seen.free_now + seen.free_later), seen.states);
  EXPECT_GT(5 * seen.wait, seen.states);
}

}  // namespace
}  // namespace armloom
