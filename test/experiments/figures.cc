#include "test/experiments/figures.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>

#include "test/experiments/fixed_orders.h"
#include "test/experiments/job_delays.h"

namespace armloom::experiments {
namespace {

constexpr Duration kTimeLimit = std::chrono::minutes(20);
constexpr double kMoves_rad = 1e-7;  // in one control cycle

// Sees which arms move, and which jobs are put off.
class Spectator final : public Observer {
 public:
  explicit Spectator(const Cell& cell) : cell_(cell), since_(cell.arms.size()) {}

  void on_event(const Event& event) override {
    const auto* job = std::get_if<JobView>(&event.body);
    if (job != nullptr && job->state == JobState::backlogged) backlogged_[job->key] = true;
  }
  void on_tick(TimePoint now, const Configuration& measured) override {
    std::size_t moving = 0;
    for (std::size_t i = 0; i < since_.size(); ++i) {
      if (!moved(i, measured)) {
        close(i, now);
        continue;
      }
      ++moving;
      if (!since_[i]) since_[i] = now;
    }
    if (moving >= 2) together_ += kControlPeriod;
    last_ = measured;
    now_ = now;
  }
  void on_state(const StateFrame&) override {}

  [[nodiscard]] std::size_t backlogged() const { return backlogged_.size(); }
  [[nodiscard]] Duration together() const { return together_; }
  [[nodiscard]] std::vector<Timeline::Bar> take_spans() {
    for (std::size_t i = 0; i < since_.size(); ++i) close(i, now_);
    return std::move(spans_);
  }

 private:
  [[nodiscard]] bool moved(std::size_t arm, const Configuration& measured) const {
    if (last_.size() != measured.size()) return false;
    return std::ranges::any_of(cell_.arms[arm].joints, [&](JointId joint) {
      const auto j = static_cast<Eigen::Index>(joint.index());
      return std::abs(measured[j] - last_[j]) > kMoves_rad;
    });
  }

  void close(std::size_t arm, TimePoint now) {
    if (since_[arm]) spans_.push_back({arm, to_seconds(*since_[arm]), to_seconds(now), ""});
    since_[arm].reset();
  }

  const Cell& cell_;
  TimePoint now_{};
  Configuration last_;
  std::vector<std::optional<TimePoint>> since_;  // by arm: moves
  std::vector<Timeline::Bar> spans_;
  std::map<std::string, bool> backlogged_;
  Duration together_{};
};

// By key.
std::map<std::string, const PlannedJob*> index_of(const std::vector<PlannedJob>& jobs) {
  std::map<std::string, const PlannedJob*> index;
  for (const PlannedJob& job : jobs) index[job.timed.job.key] = &job;
  return index;
}

// Waits, holds, and the jobs of the timeline.
void note_jobs(const SimulationResult& result, const std::vector<PlannedJob>& planned, Run& run) {
  const auto index = index_of(planned);
  std::map<std::size_t, TimePoint> free_at;  // by arm: when the job before has ended
  std::size_t started = 0;
  for (const JobView& job : result.jobs) {
    if (job.state != JobState::succeeded) {
      ++run.row.not_succeeded;
      std::cerr << run.row.workload << ", seed " << run.row.seed << ", " << run.row.policy << ": "
                << job.key << " is " << to_string(job.state) << ' ' << job.detail() << '\n';
    }
    const PlannedJob& known = *index.at(job.key);
    if (!job.times.started_at || !job.times.ended_at) continue;
    const auto before = free_at.find(known.arm.index());
    const TimePoint ready = before == free_at.end()
                                ? job.times.submitted_at
                                : std::max(job.times.submitted_at, before->second);
    free_at[known.arm.index()] = *job.times.ended_at;
    const double wait_s = to_seconds(*job.times.started_at - ready);
    run.row.wait_mean_s += wait_s;
    run.row.wait_max_s = std::max(run.row.wait_max_s, wait_s);
    run.row.held_mean_s +=
        to_seconds(*job.times.ended_at - *job.times.started_at - job.motion.duration);
    run.timeline.jobs.push_back({known.arm.index(), to_seconds(*job.times.started_at),
                                 to_seconds(*job.times.ended_at), known.kind});
    ++started;
  }
  run.row.wait_mean_s /= static_cast<double>(std::max<std::size_t>(started, 1));
  run.row.held_mean_s /= static_cast<double>(std::max<std::size_t>(started, 1));
}

}  // namespace

Run run_policy(const Workload& workload, const std::string& name, const std::string& policy,
               std::uint64_t seed, const Limits& limits) {
  const bool alone = policy == kOneArm;
  const std::vector<PlannedJob>& planned = alone ? workload.one_arm : workload.jobs;
  std::vector<TimedJob> jobs;
  for (const PlannedJob& job : planned) jobs.push_back(job.timed);
  ExecutiveOptions options;
  if (policy == kFixedOrders) {
    options.own_policy = make_fixed_orders(*workload.cell);
  } else {
    options.policy = alone ? "sequential" : policy;
  }
  options.seed = seed;
  Spectator spectator(*workload.cell);
  const bool delayed =
      std::ranges::any_of(planned, [](const PlannedJob& job) { return job.delay.has_value(); });
  auto result =
      delayed ? simulate_delayed(workload.cell, options, planned, at(kTimeLimit), spectator)
              : simulate(workload.cell, options, {std::move(jobs), at(kTimeLimit)}, spectator);
  if (!result) throw std::runtime_error(result.error().front().detail);
  if (!result->refused.empty()) {
    throw std::runtime_error(result->refused.front().problems.front().detail);
  }

  Run run{{.workload = name, .policy = policy, .seed = seed, .jobs = planned.size()}, {policy}};
  RunRow& row = run.row;
  row.limits = limits;
  note_jobs(*result, planned, run);
  run.timeline.moving = spectator.take_spans();
  row.makespan_s = to_seconds(result->figures.last_end);
  for (const Duration busy : result->figures.busy) {
    row.busy.push_back(to_seconds(busy) / row.makespan_s);
  }
  row.together = to_seconds(spectator.together()) / row.makespan_s;
  row.clearance_m = result->figures.between_arms_m;
  row.monitor_stops = result->figures.monitor_stops;
  row.backlogged = spectator.backlogged();
  row.judgements = result->judging.judgements;
  row.evaluations = result->judging.evaluations;
  row.judging_s = to_seconds(result->judging.wall);
  return run;
}

Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  if (values.empty()) return spread;
  for (const double value : values) spread.mean += value;
  spread.mean /= static_cast<double>(values.size());
  if (values.size() < 2) return spread;
  for (const double value : values) spread.deviation += std::pow(value - spread.mean, 2);
  spread.deviation = std::sqrt(spread.deviation / static_cast<double>(values.size() - 1));
  return spread;
}

}  // namespace armloom::experiments
