// Random jobs of up to five arms among a few places, of which each holds one arm: crowded enough
// for rings, long enough for aging. Whatever happens, nobody hangs without a reason: when all is at
// rest, every job that is left waits, through others or not, for an arm that has no job.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

class World {
 public:
  World(std::uint64_t seed, const char* policy)
      : random_(seed), arms_(2 + random_() % 4), places_(arms_ + 1), bench_(arms_, policy) {
    for (std::size_t arm = 0; arm < arms_; ++arm) {  // from place 0 to its own, one after the other
      bench_.submit(move({static_cast<std::uint32_t>(arm)}, 0, where(arm), 1s), now_);
      go_on_until_all_rests();
    }
  }

  void run() {
    for (int i = 0; i < 40; ++i) {
      submit();
      for (auto n = random_() % 3; n > 0; --n) go_on();
    }
    go_on_until_all_rests();
    for (JobId id : bench_.scheduler.active()) {
      EXPECT_TRUE(!is_first(id) || bench_.state(id) == JobState::backlogged)
          << "job " << id.value() << ", " << to_string(bench_.state(id)) << ", waits for "
          << to_string(bench_.job(id).waits_on.front().kind);
      EXPECT_TRUE(bench_.job(id).ring.empty() || has_cost_each_arm_a_job(bench_.job(id).ring));
    }
    EXPECT_EQ(explained(), bench_.scheduler.active().size()) << "a job hangs";
    for (const auto& [job, times] : bench_.terminal_events) {
      EXPECT_EQ(times, 1);
      const Job& ended = bench_.job(job);
      succeeded += ended.state() == JobState::succeeded ? 1 : 0;
      deadlocks += ended.reason() == Reason::deadlock ? 1 : 0;
      EXPECT_NE(ended.state(), JobState::expired);
      if (ended.reason() == Reason::deadlock) {
        const JobId last = *std::ranges::max_element(ended.ring);
        EXPECT_TRUE(last == job || lost_.contains(arm_of(last))) << "the last one gives way";
      }
    }
  }

  int succeeded = 0, deadlocks = 0, held_back = 0;

 private:
  struct Moving {
    JobId job;
    TimePoint ends;
  };

  static double where(std::size_t place) { return 0.1 * static_cast<double>(place + 1); }
  static bool same(double a, double b) { return std::abs(a - b) < 0.05; }

  void submit() {
    const auto arm = static_cast<std::uint32_t>(random_() % arms_);
    const double from = bench_.scheduler.predicted_rest()[arm];
    const double to = where(random_() % places_);
    if (same(from, to)) return;
    const Duration takes = std::chrono::seconds(1 + random_() % 40);
    bench_.submit(move({arm}, from, to, takes), now_, 1'000'000s, static_cast<int>(random_() % 3));
    settle();
  }

  // Answers as the places have it, dispatches, and lets rings be resolved.
  void settle() {
    do {
      now_ += 1ms;
      while (bench_.question || !bench_.plans.empty()) {
        bench_.answer_plans_without_way(now_);
        if (bench_.question) answer();
        now_ += 1ms;
      }
      while (!bench_.dispatched.empty()) {
        const Dispatch dispatch = bench_.dispatched.back();
        bench_.dispatched.pop_back();
        now_ = std::max(now_, dispatch.start_at);
        moving_.push_back({dispatch.job, now_ + bench_.job(dispatch.job).trajectory->duration()});
        bench_.progressed(dispatch.job, Duration{}, now_);
      }
      now_ += 1ms;
      bench_.step(Wake{}, now_);
    } while (bench_.question || !bench_.plans.empty() || !bench_.dispatched.empty());
    for (const auto& [job, times] : bench_.terminal_events) {
      if (bench_.job(job).reason() == Reason::deadlock) lost_.insert(arm_of(job));
    }
    for (JobId id : bench_.scheduler.active()) {
      for (const Wait& wait : bench_.job(id).waits_on) {
        held_back += wait.kind == Wait::Kind::order && is_first(id) ? 1 : 0;
      }
    }
  }

  // A motion takes its place with it from its start, and the other one already.
  void answer() {
    const Question question = *bench_.question;
    bench_.question.reset();
    const Motion& own = question.candidates.front();
    const double to = own.trajectory->goal()[0];
    Verdict verdict{Verdict::Kind::free, question.version, {}, {}, 1};
    std::set<ArmId> in_motion{own.trajectory->arms().front()};
    const auto add = [&](Conflict::With with, std::optional<JobId> job, ArmId arm) {
      verdict.kind = Verdict::Kind::conflict;
      verdict.conflicts.push_back({with, own.job, job, Proximity{.arm_b = arm}, 0s, 0s});
    };
    for (const Motion& other : question.others) {
      const ArmId arm = other.trajectory->arms().front();
      in_motion.insert(arm);
      const bool meets =
          same(other.trajectory->goal()[0], to) || same(other.trajectory->start()[0], to);
      if (meets) add(Conflict::With::motion, other.job, arm);
    }
    for (std::uint32_t arm = 0; arm < arms_; ++arm) {
      if (in_motion.contains(ArmId{arm}) || !same(question.rest[arm], to)) continue;
      add(Conflict::With::rest, {}, ArmId{arm});
    }
    bench_.step(Judged{std::move(verdict)}, now_);
  }

  // Until the next motion ends; false: nothing moves.
  bool go_on() {
    settle();
    if (moving_.empty()) return false;
    const auto next = std::ranges::min_element(moving_, {}, &Moving::ends);
    now_ = std::max(now_, next->ends);
    const JobId job = next->job;
    moving_.erase(next);
    bench_.finished(job, now_);
    settle();
    return true;
  }
  void go_on_until_all_rests() {
    while (go_on()) {
    }
  }

  bool is_first(JobId id) const {
    const auto arms = [this](JobId job) { return bench_.job(job).trajectory->arms(); };
    const std::vector<JobId> active = bench_.scheduler.active();
    return std::ranges::none_of(active,
                                [&](JobId other) { return other < id && arms(other) == arms(id); });
  }

  ArmId arm_of(JobId job) const { return bench_.job(job).trajectory->arms().front(); }

  // A ring that is left to its timeouts: each arm of it has lost a job to one before.
  bool has_cost_each_arm_a_job(const WaitCycle& ring) const {
    return std::ranges::all_of(ring, [&](JobId job) { return lost_.contains(arm_of(job)); });
  }

  // How many jobs wait for an arm without a job, or in a ring that is left to its timeouts,
  // directly or through others.
  std::size_t explained() const {
    std::set<JobId> known;
    std::set<ArmId> with_job;
    const std::vector<JobId> active = bench_.scheduler.active();
    for (JobId id : active) {
      with_job.insert(arm_of(id));
      if (!bench_.job(id).ring.empty()) known.insert(id);
    }
    for (std::size_t before = active.size() + 1; before != known.size();) {
      before = known.size();
      for (JobId id : active) {
        for (const Wait& wait : bench_.job(id).waits_on) {
          bool why = wait.job && known.contains(*wait.job);
          if (wait.kind == Wait::Kind::arm) {
            why = !with_job.contains(*wait.arm);
            for (JobId other : active) {
              why |= known.contains(other) &&
                     bench_.job(other).trajectory->arms().front() == *wait.arm;
            }
          }
          if (why) known.insert(id);
        }
      }
    }
    return known.size();
  }

  std::mt19937_64 random_;
  std::size_t arms_, places_;
  Bench bench_;
  TimePoint now_{};
  std::vector<Moving> moving_;
  std::set<ArmId> lost_;  // arms of jobs that have failed for a ring
};

class Turns : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Policies, Turns, ::testing::Values("certified", "sequential", "lockstep"));

TEST_P(Turns, NobodyHangsWithoutAReasonIn400RandomCrowdedWorlds) {
  int succeeded = 0, deadlocks = 0, held_back = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    World world(seed, GetParam());
    world.run();
    succeeded += world.succeeded;
    deadlocks += world.deadlocks;
    held_back += world.held_back;
    if (HasFailure()) break;
  }
  EXPECT_GT(succeeded, 2000);
  EXPECT_GT(deadlocks, 50);
  const bool ages = GetParam() == std::string("certified");
  EXPECT_TRUE(!ages || held_back > 500) << "aging had work to do: " << held_back;
}

}  // namespace
}  // namespace armloom
