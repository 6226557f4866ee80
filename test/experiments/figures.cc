#include "test/experiments/figures.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <stdexcept>

#include "test/experiments/fixed_orders.h"
#include "test/experiments/job_delays.h"

namespace armloom::experiments {
namespace {

constexpr Duration kTimeLimit = std::chrono::minutes(20);
constexpr double kMoves_rad = 1e-7;  // in one control cycle

class Spectator final : public Observer {
 public:
  explicit Spectator(const Cell& cell) : cell_(cell) {}

  void on_event(const Event& event) override {
    const auto* job = std::get_if<JobView>(&event.body);
    if (job != nullptr && job->state == JobState::backlogged) backlogged_[job->key] = true;
  }
  void on_tick(TimePoint, const Configuration& measured) override {
    std::size_t moving = 0;
    for (std::size_t i = 0; i < cell_.arms.size(); ++i) moving += moved(i, measured) ? 1 : 0;
    if (moving >= 2) together_ += kControlPeriod;
    last_ = measured;
  }
  void on_state(const StateFrame&) override {}

  [[nodiscard]] std::size_t backlogged() const { return backlogged_.size(); }
  [[nodiscard]] Duration together() const { return together_; }

 private:
  [[nodiscard]] bool moved(std::size_t arm, const Configuration& measured) const {
    if (last_.size() != measured.size()) return false;
    return std::ranges::any_of(cell_.arms[arm].joints, [&](JointId joint) {
      const auto j = static_cast<Eigen::Index>(joint.index());
      return std::abs(measured[j] - last_[j]) > kMoves_rad;
    });
  }

  const Cell& cell_;
  Configuration last_;
  std::map<std::string, bool> backlogged_;
  Duration together_{};
};

std::map<std::string, const PlannedJob*> index_of(const std::vector<PlannedJob>& jobs) {
  std::map<std::string, const PlannedJob*> index;
  for (const PlannedJob& job : jobs) index[job.timed.job.key] = &job;
  return index;
}

void note_jobs(const SimulationResult& result, const std::vector<PlannedJob>& planned,
               RunRow& row) {
  const auto index = index_of(planned);
  std::map<std::size_t, TimePoint> free_at;  // by arm: when the previous job has ended
  std::size_t started = 0;
  for (const JobView& job : result.jobs) {
    const auto own = index.find(job.key);
    if (own == index.end()) continue;  // a retreat
    if (job.state != JobState::succeeded) {
      ++row.not_succeeded;
      std::cerr << row.workload << ", seed " << row.seed << ", " << row.policy << ": " << job.key
                << " is " << to_string(job.state) << ' ' << job.detail();
      for (const WaitView& wait : job.waits_on) {
        std::cerr << "; waits on " << to_string(wait.kind) << ' ' << wait.job << ' ' << wait.arm
                  << ' ' << wait.detail;
      }
      std::cerr << '\n';
    }
    const PlannedJob& known = *own->second;
    if (!job.times.started_at || !job.times.ended_at) continue;
    const auto before = free_at.find(known.arm.index());
    const TimePoint ready = before == free_at.end()
                                ? job.times.submitted_at
                                : std::max(job.times.submitted_at, before->second);
    free_at[known.arm.index()] = *job.times.ended_at;
    const double wait_s = to_seconds(*job.times.started_at - ready);
    row.wait_mean_s += wait_s;
    row.wait_max_s = std::max(row.wait_max_s, wait_s);
    row.held_mean_s +=
        to_seconds(*job.times.ended_at - *job.times.started_at - job.motion.duration);
    ++started;
  }
  row.wait_mean_s /= static_cast<double>(std::max<std::size_t>(started, 1));
  row.held_mean_s /= static_cast<double>(std::max<std::size_t>(started, 1));
}

}  // namespace

RunRow run_policy(const Workload& workload, const std::string& name, const std::string& policy,
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

  RunRow row{.workload = name, .policy = policy, .seed = seed, .jobs = planned.size()};
  row.limits = limits;
  note_jobs(*result, planned, row);
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
  return row;
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
