// Measures decision time (processor time) on one thread: from submission to admission or rejection,
// including geometry. In a cell of 48 Pandas 15 motions run, 30 are admitted but not started, and
// 200 jobs wait. `coordinated` also admits the waiting jobs within its horizon. Under `lockstep` no
// job of the round moves yet; under `sequential` all other arms rest. Candidates have new motions
// each time.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "core/collision/diagram/motion_store.h"
#include "core/collision/scene/planning_scene.h"
#include "core/scheduler/scheduler.h"
#include "core/trajectory/validate.h"
#include "test/bench/cells.h"
#include "test/bench/motions.h"

namespace armloom::bench {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kColumns = 8, kRows = 6;
constexpr double kReach = 0.5;
// Factors that scale a random motion about home. With kShare neighboring arms stay clear of each
// other; with kCrossingShare their motions cross.
constexpr double kShare = 0.5, kCrossingShare = 1.0;
constexpr std::size_t kAdmitted = 45, kRunning = 15;
constexpr std::size_t kFree[] = {18, 28, 29};  // arms in the middle, which get the candidates
constexpr std::size_t kDecisions = 300, kDecisionsOfGrowth = 100;

struct Load {
  double spacing_m = 1.2;
  std::size_t waiting = 200;
  int horizon_steps = SchedulingSettings{}.horizon_steps;
};

CellPtr hall_of(const Load& load) {
  Cell cell = *grid_of_pandas(kColumns, kRows, load.spacing_m);
  cell.scheduling.horizon_steps = load.horizon_steps;
  return std::make_shared<const Cell>(std::move(cell));
}

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

class Hall {
 public:
  Hall(const std::string& policy, double share, const Load& load)
      : looks_ahead_(policy == "coordinated"),
        running_(policy == "lockstep" ? 0 : kRunning),
        waiting_(load.waiting),
        share_(share),
        cell_(hall_of(load)),
        checker_(*PlanningScene::build(cell_)),
        chooses_(*PlanningScene::build(cell_)),
        scheduler_(cell_, std::move(*make_policy(policy, *cell_)), cell_->home()) {
    if (policy != "sequential") fill();
  }

  // Returns a new motion that the arm can make alone.
  TrajectoryPtr new_motion(ArmId arm) {
    while (true) {
      const auto random = random_motion(*cell_, arm, ++seed_, kReach);
      const auto found = from_home(*cell_, arm, *random, share_, false);
      if (!found || !alone(*found)) continue;
      random_[*found] = random;
      return *found;
    }
  }

  [[nodiscard]] double in_reach() const {
    const MotionStore store(*PlanningScene::build(cell_));
    double all = 0.0;
    for (const std::size_t arm : kFree) {
      for (std::uint32_t other = 0; other < cell_->arms.size(); ++other) {
        const ArmId own{static_cast<std::uint32_t>(arm)};
        if (other != arm && !store.out_of_reach(own, ArmId{other})) all += 1.0;
      }
    }
    return all / static_cast<double>(std::size(kFree));
  }

  struct Decision {
    double took_ms;
    bool admitted;
    std::size_t questions;
  };
  Decision decide(const TrajectoryPtr& motion) {
    const double begun_ms = processor_ms();
    const JobId job = submit(motion);
    std::size_t questions = 0;
    while (scheduler_.find(job)->state() == JobState::queued && answer_one()) ++questions;
    const double took_ms = processor_ms() - begun_ms;
    const bool admitted = scheduler_.find(job)->state() == JobState::scheduled;
    withdraw(job);
    return {took_ms, admitted, questions};
  }

  [[nodiscard]] std::size_t count(JobState state) const {
    const auto jobs = scheduler_.active();
    return static_cast<std::size_t>(std::ranges::count_if(
        jobs, [&](JobId id) { return scheduler_.find(id)->state() == state; }));
  }

 private:
  [[nodiscard]] bool alone(const TrajectoryPtr& motion) {
    const Question question{.version = 1,
                            .start_at = TimePoint{},
                            .candidates = {{StepId{JobId{1}}, motion, Duration{}}},
                            .others = {},
                            .rest = cell_->home(),
                            .method = Coordinated{TrackingErrors(*cell_)}};
    return chooses_.judge(question).kind == Verdict::Kind::free;
  }

  void fill() {
    std::size_t admitted = 0, waiting = 0;
    std::vector<TrajectoryPtr> out(cell_->arms.size());
    for (std::uint32_t i = 0; i < cell_->arms.size(); ++i) {
      if (std::ranges::find(kFree, i) != std::end(kFree)) continue;
      while (!out[i]) {
        const TrajectoryPtr motion = new_motion(ArmId{i});
        const JobId job = submit(motion);
        answer_all();
        if (scheduler_.find(job)->state() != JobState::scheduled) {
          withdraw(job);
          continue;
        }
        out[i] = motion;
        if (admitted++ < running_) run(job);
      }
    }
    for (std::size_t round = 0; waiting < waiting_; ++round) {
      for (std::uint32_t i = 0; i < out.size() && waiting < waiting_; ++i) {
        if (!out[i]) continue;
        const bool back = round % 2 == 0;
        submit(back ? *from_home(*cell_, ArmId{i}, *random_.at(out[i]), share_, true) : out[i]);
        ++waiting;
      }
    }
    answer_all();
    const std::size_t scheduled = kAdmitted - running_;
    const bool as_wanted =
        count(JobState::running) == running_ &&
        (looks_ahead_ || count(JobState::scheduled) == scheduled) &&
        count(JobState::scheduled) + count(JobState::queued) == scheduled + waiting_;
    if (!as_wanted) throw std::runtime_error("the hall is not as it was to be");
  }

  JobId submit(const TrajectoryPtr& motion) {
    const JobId job{++last_};
    step(Submit{job, motion, {0, 3600s}});
    return job;
  }
  void run(JobId job) { step(MotionReport{only_step(job), MotionReport::Kind::progressed, 1ms}); }
  void withdraw(JobId job) {
    step(Cancel{job});
    const Step& canceled = *scheduler_.find(job);
    if (!is_terminal(canceled.state())) {  // its arm already had the motion
      step(MotionReport{only_step(job), MotionReport::Kind::stopped, Duration{},
                        canceled.trajectory->start()});
    }
    answer_all();
    scheduler_.forget(job);
  }

  void step(const Input& input) {
    for (Effect& effect : scheduler_.step(input, now_)) {
      if (auto* judge = std::get_if<Judge>(&effect)) question_ = std::move(judge->question);
    }
  }
  bool answer_one() {
    if (!question_) return false;
    const Question question = std::move(*question_);
    question_.reset();
    step(Judged{checker_.judge(question)});
    return true;
  }
  void answer_all() {
    while (answer_one()) {
    }
  }

  bool looks_ahead_;
  std::size_t running_;
  std::size_t waiting_;
  double share_;
  CellPtr cell_;
  MotionChecker checker_;
  MotionChecker chooses_;  // separate, so that it warms no cache of the measured checker
  Scheduler scheduler_;
  // by scaled motion: the random motion that it was made from
  std::map<TrajectoryPtr, TrajectoryPtr> random_;
  std::optional<Question> question_;
  TimePoint now_{};
  std::uint64_t last_ = 0;
  std::uint64_t seed_ = 0;
};

void decision(benchmark::State& state, const std::string& policy, double share, const Load& load,
              std::size_t decisions) {
  Hall hall(policy, share, load);
  std::vector<double> took_ms;
  double admitted = 0.0, questions = 0.0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < decisions; ++i) {
      const ArmId arm{static_cast<std::uint32_t>(kFree[i % std::size(kFree)])};
      const TrajectoryPtr motion = hall.new_motion(arm);
      const Hall::Decision decided = hall.decide(motion);
      took_ms.push_back(decided.took_ms);
      admitted += decided.admitted ? 1.0 : 0.0;
      questions += static_cast<double>(decided.questions);
    }
  }
  std::ranges::sort(took_ms);
  const auto count = static_cast<double>(took_ms.size());
  state.counters["median_ms"] = took_ms[took_ms.size() / 2];
  state.counters["p99_ms"] = took_ms[took_ms.size() * 99 / 100];
  state.counters["max_ms"] = took_ms.back();
  state.counters["admitted"] = admitted / count;
  state.counters["scheduled"] = static_cast<double>(hall.count(JobState::scheduled));
  state.counters["questions"] = questions / count;
  state.counters["in_reach"] = hall.in_reach();
  state.counters["waiting"] = static_cast<double>(load.waiting);
  state.counters["horizon_steps"] = static_cast<double>(load.horizon_steps);
}

// Rows "growth/": one of three parameters grows (growth.py makes the README's table).
void register_growth(const std::string& policy, double share, const std::string& name,
                     const Load& load) {
  benchmark::RegisterBenchmark(
      ("growth/" + name).c_str(),
      [=](auto& state) { decision(state, policy, share, load, kDecisionsOfGrowth); })
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

const bool kRegistered = [] {
  for (const char* policy :
       {"sequential", "lockstep", "reservation", "certified", "earliest_start", "coordinated"}) {
    for (const auto& [name, share] :
         {std::pair("decision/", kShare), {"crossing/", kCrossingShare}}) {
      benchmark::RegisterBenchmark(
          (std::string(name) + policy).c_str(),
          [policy, share](auto& state) { decision(state, policy, share, {}, kDecisions); })
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
    }
  }
  for (const int legs : {1, 2, 3, 4, 6, 8, 12}) {
    register_growth("coordinated", kShare, "horizon:" + std::to_string(legs),
                    {.horizon_steps = legs});
  }
  for (const std::size_t waiting : {0, 50, 100, 200, 400, 800}) {
    register_growth("coordinated", kShare, "waiting:" + std::to_string(waiting),
                    {.waiting = waiting});
  }
  for (const double spacing_m : {2.4, 1.8, 1.5, 1.2, 1.0}) {
    register_growth("coordinated", kShare,
                    "spacing_cm:" + std::to_string(std::lround(100.0 * spacing_m)),
                    {.spacing_m = spacing_m});
  }
  return true;
}();

}  // namespace
}  // namespace armloom::bench
