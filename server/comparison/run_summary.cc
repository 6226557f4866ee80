#include "server/comparison/run_summary.h"

#include <algorithm>

namespace armloom {

TimePoint time_limit(const std::vector<TimedJob>& jobs, const std::vector<FaultRequest>& faults,
                     const Cell& cell) {
  double limit_s = 60.0;
  double last_s = 0.0;
  for (const FaultRequest& fault : faults) {
    limit_s += to_seconds(fault.lasting.value_or(Duration{}));
  }
  for (const TimedJob& timed : jobs) {
    double duration_s = 0.0;
    for (const auto& [place, motion] : timed.job.motions()) {
      if (motion.points.empty()) continue;
      duration_s = std::max(duration_s, motion.points.back().time_from_start_s);
    }
    limit_s +=
        to_seconds(timed.job.terms.backlog_timeout.value_or(cell.scheduling.backlog_timeout)) +
        duration_s * cell.execution.duration_scaling + to_seconds(cell.execution.duration_margin);
    last_s = std::max(last_s, to_seconds(timed.at));
  }
  return at(from_seconds(last_s + limit_s));
}

RunSummary summarise(const SimulationResult& result, TimePoint first_submit) {
  RunSummary summary;
  for (const JobState state : kJobEnds) {
    summary.jobs[to_string(state)] = 0;
  }
  summary.jobs["refused"] = result.refused.size();
  std::int64_t started = 0;
  Duration wait_sum{};
  for (const JobView& job : result.jobs) {
    if (job.system_job) continue;
    ++summary.jobs[to_string(job.state)];
    if (!job.times.started_at) continue;
    const Duration wait = *job.times.started_at - job.times.submitted_at;
    ++started;
    wait_sum += wait;
    summary.wait_max = std::max(summary.wait_max, wait);
  }
  if (started > 0) summary.wait_mean = wait_sum / started;
  if (started > 0) summary.makespan = result.figures.last_end - first_submit;
  summary.span = result.all_ended ? summary.makespan : result.ended_at - first_submit;
  return summary;
}

}  // namespace armloom
