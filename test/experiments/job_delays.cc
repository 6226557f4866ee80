#include "test/experiments/job_delays.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "test/experiments/joined_diagram.h"
#include "test/experiments/moves.h"

namespace armloom::experiments {
namespace {

// Makes the arms of delayed jobs late and slow. An observer must not send commands, so faults are
// injected after the tick.
class Delays final : public Observer {
 public:
  Delays(const Cell& cell, const std::vector<PlannedJob>& jobs, Observer& inner)
      : cell_(cell), of_arm_(cell.arms.size()), inner_(inner) {
    for (const PlannedJob& job : jobs) of_arm_[job.arm.index()].push_back({&job});
    for (std::vector<Delayed>& arm : of_arm_) {
      for (std::size_t i = 0; i < arm.size(); ++i) {
        by_key_[arm[i].job->timed.job.key] = {&arm[i], i + 1 < arm.size() ? &arm[i + 1] : nullptr};
      }
    }
  }

  void begin(Executive& executive) {
    for (std::vector<Delayed>& arm : of_arm_) {
      if (!arm.empty()) make_late(executive, arm.front());
    }
  }
  void catch_up(Executive& executive) {
    for (const JobView& view : std::exchange(heard_, {})) {
      const auto [job, next] = by_key_.at(view.key);
      if (view.times.started_at && !job->has_started) {
        job->has_started = true;
        lift(executive, job->late);
        if (job->job->delay) {
          job->slow = inject(executive, *job, ArmFault::Kind::slow, job->job->delay->speed);
        }
        if (next != nullptr) make_late(executive, *next);
      }
      if (view.times.ended_at) lift(executive, job->slow);
    }
  }

  void on_event(const Event& event) override {
    const auto* job = std::get_if<JobView>(&event.body);
    if (job != nullptr && by_key_.contains(job->key)) heard_.push_back(*job);
    inner_.on_event(event);
  }
  void on_tick(TimePoint now, const Configuration& measured) override {
    inner_.on_tick(now, measured);
  }
  void on_rest(bool at_rest) override { inner_.on_rest(at_rest); }
  void on_state(const StateFrame& frame) override { inner_.on_state(frame); }

 private:
  using Fault = std::optional<std::uint64_t>;
  struct Delayed {
    const PlannedJob* job;
    bool has_started = false;
    Fault late = {};
    Fault slow = {};
  };

  void make_late(Executive& executive, Delayed& job) {
    if (!job.job->delay) return;
    job.late = inject(executive, job, ArmFault::Kind::late_start, job.job->delay->late_s);
  }
  Fault inject(Executive& executive, const Delayed& job, ArmFault::Kind kind, double value) {
    return *executive.faults().inject(
        {.arm = cell_.arm(job.job->arm).name, .kind = kind, .value = value});
  }
  static void lift(Executive& executive, Fault& fault) {
    if (!fault) return;
    const auto lifted = executive.faults().remove(*std::exchange(fault, std::nullopt));
    if (!lifted) throw std::logic_error(lifted.error().front().detail);
  }

  const Cell& cell_;
  std::vector<std::vector<Delayed>> of_arm_;                     // in order
  std::map<std::string, std::pair<Delayed*, Delayed*>> by_key_;  // with the arm's next job
  std::vector<JobView> heard_;
  Observer& inner_;
};

}  // namespace

void delay_some(std::vector<PlannedJob>& jobs, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double share = uniform(random, kLeastShare, kMostShare);
  for (PlannedJob& job : jobs) {
    const double late_s = uniform(random, 0.0, kLatest_s);
    const double speed = uniform(random, kSlowest, kFastest);
    if (uniform(random, 0.0, 1.0) < share) job.delay = JobDelay{late_s, speed};
  }
}

TrajectoryPtr as_delayed(const Trajectory& motion, const JobDelay& delay) {
  constexpr Duration kSquare = JoinedDiagram::kSquare;
  const Duration late = from_seconds(delay.late_s) / kSquare * kSquare;
  const Duration takes =
      from_seconds(to_seconds(motion.duration()) / delay.speed) / kSquare * kSquare;
  const double rate = to_seconds(motion.duration()) / to_seconds(takes);
  std::vector<Segment> segments;
  if (late > Duration{}) {
    Segment stands{Duration{}, late, {}};
    stands.coefficients.setZero(motion.start().size(), 6);
    stands.coefficients.col(0) = motion.start();
    segments.push_back(std::move(stands));
  }
  const auto when = [&](Duration time) { return from_seconds(to_seconds(time) / rate); };
  for (const Segment& whole : motion.segments()) {
    const Duration from = when(whole.start);
    const bool is_last = whole.start + whole.duration == motion.duration();
    const Duration to = is_last ? takes : when(whole.start + whole.duration);
    Segment slow{late + from, to - from, whole.coefficients};
    for (int k = 1; k < 6; ++k) slow.coefficients.col(k) *= std::pow(rate, k);
    segments.push_back(std::move(slow));
  }
  return std::make_shared<const Trajectory>(motion.joints(), motion.arms(), std::move(segments));
}

Result<SimulationResult> simulate_delayed(const CellPtr& cell, ExecutiveOptions options,
                                          const std::vector<PlannedJob>& jobs, TimePoint time_limit,
                                          Observer& observer) {
  Delays delays(*cell, jobs, observer);
  auto simulation = Simulation::create(cell, std::move(options), delays);
  if (!simulation) return failure(std::move(simulation.error()));
  Executive& executive = (*simulation)->executive();
  delays.begin(executive);
  SimulationResult result;
  auto next = jobs.begin();
  while (!result.all_ended && (*simulation)->now() < time_limit) {
    (*simulation)->tick();
    for (; next != jobs.end() && next->timed.at <= executive.now(); ++next) {
      auto accepted = executive.submit(next->timed.job);
      if (!accepted) {
        const auto index = static_cast<std::size_t>(next - jobs.begin());
        result.refused.push_back({index, std::move(accepted.error())});
      }
    }
    delays.catch_up(executive);
    result.all_ended = next == jobs.end() && executive.all_ended();
  }
  result.figures = executive.figures();
  result.judging = (*simulation)->judging();
  result.jobs = executive.snapshot().jobs;
  return result;
}

}  // namespace armloom::experiments
