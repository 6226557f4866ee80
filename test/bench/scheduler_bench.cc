// The scheduler's own step with many waiting jobs and a fake checker that answers at once.
#include <benchmark/benchmark.h>
#include <time.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scheduler/scheduler.h"
#include "test/bench/run_benchmarks.h"
#include "test/scheduler/one_joint_arms.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kArms = 16;
constexpr ArmId kRuns{0};              // has a job in motion
constexpr ArmId kInTheWay{kArms - 1};  // at rest without jobs: all other arms wait for it

// From home to home, so that an arm's jobs can follow each other.
TrajectoryPtr motion_of(ArmId arm) {
  Segment segment{.start = Duration{}, .duration = 10s, .coefficients = {}};
  segment.coefficients.setZero(1, 6);
  return std::make_shared<const Trajectory>(std::vector{JointId{arm.value()}}, std::vector{arm},
                                            std::vector{segment});
}

// Puts `waiting` jobs on the middle arms, and one job in motion on the first. Checks of the middle
// arms are answered with "the last arm rests in the way".
class Crowd {
 public:
  Crowd(const std::string& policy, std::size_t waiting)
      : cell_(one_joint_arms(kArms)),
        scheduler_(cell_, std::move(*make_policy(policy, *cell_)), cell_->home()) {
    for (std::uint32_t i = 0; i < kArms; ++i) motions_.push_back(motion_of(ArmId{i}));
    for (std::size_t n = 0; n < waiting; ++n) {
      submit(arm_of(n));
      answer_all();
    }
    run_first();
  }

  JobId submit(ArmId arm) {
    const JobId job{++last_};
    step(Submit{job, motions_[arm.index()], {0, 3600s}});
    return job;
  }
  std::vector<JobId> submit_batch(std::size_t count) {
    benchmark::DoNotOptimize(predicted_rest(scheduler_.state()));
    std::vector<JobId> jobs;
    for (std::size_t n = 0; n < count; ++n) jobs.push_back(submit(arm_of(n)));
    return jobs;
  }
  void answer_all() {
    while (question_) {
      Verdict verdict = answer(*question_);
      question_.reset();
      step(Judged{std::move(verdict)});
    }
  }
  void cancel(JobId job) {
    step(Cancel{job});
    answer_all();
  }
  void run_first() {
    running_ = submit(kRuns);
    answer_all();
    progress_ = Duration{};
    progressed();
  }
  void progressed() {
    now_ += 1ms;
    progress_ += 1ms;
    step(MotionReport{only_step(running_), MotionReport::Kind::progressed, progress_});
  }
  void finished() {
    step(MotionReport{only_step(running_), MotionReport::Kind::finished, 10s,
                      Eigen::VectorXd::Zero(1)});
    answer_all();
  }
  [[nodiscard]] bool nearly_done() const { return progress_ > 9s; }
  void forget_ended() { scheduler_.forget(running_); }
  void forget(JobId job) { scheduler_.forget(job); }

 private:
  static ArmId arm_of(std::size_t n) {
    return ArmId{static_cast<std::uint32_t>(1 + n % (kArms - 2))};
  }
  void step(const Input& input) {
    for (Effect& effect : scheduler_.step(input, now_)) {
      if (auto* judge = std::get_if<Judge>(&effect)) question_ = std::move(judge->question);
    }
  }

  [[nodiscard]] static Verdict answer(const Question& question) {
    Verdict verdict{Verdict::Kind::free, question.version, {}, {}, 1};
    const Motion& motion = question.candidates.front();
    if (motion.trajectory->arms().front() == kRuns) return verdict;
    const Proximity proximity{.body_a = "own", .body_b = "other", .arm_b = kInTheWay};
    if (std::holds_alternative<Coordinated>(question.method)) {
      const ProgressBox box{1s, 2s, Duration{}, Duration{}};
      verdict.regions.push_back({motion.step, kInTheWay, {{{box}, proximity, 1s, Duration{}}}});
    } else {
      verdict.kind = Verdict::Kind::conflict;
      verdict.conflicts.push_back(
          {Conflict::With::rest, motion.step, std::nullopt, proximity, 1s, Duration{}});
    }
    return verdict;
  }

  CellPtr cell_;
  Scheduler scheduler_;
  std::vector<TrajectoryPtr> motions_;
  std::optional<Question> question_;
  TimePoint now_{};
  std::uint64_t last_ = 0;
  JobId running_{0};
  Duration progress_{};
};

// Created once: submitting 10,000 jobs takes a minute.
Crowd& crowd_of(const std::string& policy, std::size_t waiting) {
  static std::map<std::pair<std::string, std::size_t>, std::unique_ptr<Crowd>> made;
  auto& crowd = made[{policy, waiting}];
  if (!crowd) crowd = std::make_unique<Crowd>(policy, waiting);
  return *crowd;
}

using Clock = std::chrono::steady_clock;
void took(benchmark::State& state, Clock::time_point since) {
  state.SetIterationTime(std::chrono::duration<double>(Clock::now() - since).count());
}
void sized(benchmark::State& state) { state.SetComplexityN(state.range(0)); }

void submit(benchmark::State& state, const std::string& policy) {
  Crowd& crowd = crowd_of(policy, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    const auto begun = Clock::now();
    const JobId job = crowd.submit(ArmId{1});
    crowd.answer_all();
    took(state, begun);
    crowd.cancel(job);
    crowd.forget(job);
  }
  sized(state);
}

void finished(benchmark::State& state, const std::string& policy) {
  Crowd& crowd = crowd_of(policy, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    const auto begun = Clock::now();
    crowd.finished();
    took(state, begun);
    crowd.forget_ended();
    crowd.run_first();
  }
  sized(state);
}

void progressed(benchmark::State& state, const std::string& policy) {
  Crowd& crowd = crowd_of(policy, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    const auto begun = Clock::now();
    crowd.progressed();
    took(state, begun);
    if (crowd.nearly_done()) {
      crowd.finished();
      crowd.forget_ended();
      crowd.run_first();
    }
  }
  sized(state);
}

// Excludes other work on the machine.
double thread_time_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// A batch of a thousand jobs; the resulting checks and the cancellation are not measured.
void batch(benchmark::State& state, const std::string& policy) {
  Crowd& crowd = crowd_of(policy, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    const double begun_s = thread_time_s();
    const std::vector<JobId> jobs = crowd.submit_batch(1000);
    state.SetIterationTime(thread_time_s() - begun_s);
    crowd.answer_all();
    for (auto job = jobs.rbegin(); job != jobs.rend(); ++job) {
      crowd.cancel(*job);
      crowd.forget(*job);
    }
  }
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgName("waiting")
      ->Arg(100)
      ->Arg(1000)
      ->Arg(10000)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond)
      ->Complexity(benchmark::oLogN);
}

void thousand(benchmark::internal::Benchmark* bench) {
  bench->ArgName("waiting")->Arg(9000)->UseManualTime()->Iterations(10)->Unit(
      benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(batch, earliest_start, "earliest_start")->Apply(thousand);
BENCHMARK_CAPTURE(batch, coordinated, "coordinated")->Apply(thousand);
BENCHMARK_CAPTURE(submit, earliest_start, "earliest_start")->Apply(sizes);
BENCHMARK_CAPTURE(submit, coordinated, "coordinated")->Apply(sizes);
BENCHMARK_CAPTURE(finished, earliest_start, "earliest_start")->Apply(sizes);
BENCHMARK_CAPTURE(finished, coordinated, "coordinated")->Apply(sizes);
BENCHMARK_CAPTURE(progressed, earliest_start, "earliest_start")->Apply(sizes);
BENCHMARK_CAPTURE(progressed, coordinated, "coordinated")->Apply(sizes);

}  // namespace
}  // namespace armloom

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  return armloom::bench::run_benchmarks();
}
