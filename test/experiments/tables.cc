#include "test/experiments/tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace armloom::experiments {
namespace {

using Rows = std::vector<const RunRow*>;

double mean(const Rows& rows, const auto& figure) {
  double sum = 0.0;
  for (const RunRow* row : rows) sum += figure(*row);
  return sum / static_cast<double>(rows.size());
}
std::string joined(const std::vector<std::string>& cells, const std::string& between) {
  std::string text;
  for (const std::string& cell : cells) text += (text.empty() ? "" : between) + cell;
  return text;
}
std::string table_row(const std::vector<std::string>& cells) {
  return "| " + joined(cells, " | ") + " |\n";
}
std::string rule(std::size_t columns) {
  std::string text = "|---|";
  for (std::size_t i = 1; i < columns; ++i) text += "---:|";
  return text + "\n";
}
double busy(const RunRow& row) {
  double sum = 0.0;
  for (const double arm : row.busy) sum += arm;
  return sum / static_cast<double>(row.busy.size());
}
double per_job(std::uint64_t count, const RunRow& row) {
  return static_cast<double>(count) / static_cast<double>(row.jobs);
}

std::string policy_row(const std::string& policy, const Rows& rows, double sequential_s) {
  const bool has_limits = policy != kOneArm && mean_bound_s(rows) > 0.0;
  const Spread makespan = spread_of(rows, &RunRow::makespan_s);
  double clearance_m = std::numeric_limits<double>::infinity();
  double wait_max_s = 0.0;
  std::uint64_t stops = 0;
  std::size_t jobs = 0;
  std::size_t succeeded = 0;
  for (const RunRow* row : rows) {
    clearance_m = std::min(clearance_m, row->clearance_m);
    wait_max_s = std::max(wait_max_s, row->wait_max_s);
    stops += row->monitor_stops;
    jobs += row->jobs;
    succeeded += row->jobs - row->not_succeeded;
  }
  return table_row({
      "`" + policy + "`",
      fixed(makespan.mean, 2) + " ± " + fixed(makespan.deviation, 2),
      sequential_s > 0.0 ? fixed(makespan.mean / sequential_s, 2) : "-",
      has_limits ? fixed(makespan.mean / mean_bound_s(rows), 2) : "-",
      has_limits ? fixed(spread_of(of_optimum(rows)).mean, 3) : "-",
      has_limits ? fixed(std::ranges::max(of_optimum(rows)), 3) : "-",
      fixed(100.0 * mean(rows, busy), 0) + " %",
      fixed(100.0 * spread_of(rows, &RunRow::together).mean, 0) + " %",
      fixed(spread_of(rows, &RunRow::wait_mean_s).mean, 2),
      fixed(wait_max_s, 1),
      fixed(spread_of(rows, &RunRow::held_mean_s).mean, 2),
      fixed(100.0 * mean(rows, [](const RunRow& row) { return per_job(row.backlogged, row); }), 0) +
          " %",
      fixed(mean(rows, [](const RunRow& row) { return per_job(row.judgements, row) - 1.0; }), 2),
      fixed(mean(rows, [](const RunRow& row) { return per_job(row.evaluations, row); }), 0),
      std::isfinite(clearance_m) ? fixed(clearance_m * 1e3, 1) : "-",
      std::to_string(stops),
      std::to_string(succeeded) + " of " + std::to_string(jobs),
  });
}

std::string workload_heading(const WorkloadKind& kind, const Rows& any) {
  const auto limit = [&](const auto& part) {
    return fixed(mean(any, [&](const RunRow& row) { return part(row.limits); }), 2) + " s";
  };
  const std::string jobs =
      "\n## " + kind.title + "\n\n" + std::to_string(any.front()->jobs) + " jobs.";
  if (kind.of_tasks) return jobs + "\n\n";
  return jobs + " Lower bound " + limit([](const Limits& l) { return l.bound.bound_s(); }) +
         ": the busiest arm's own work " + limit([](const Limits& l) { return l.bound.own_s; }) +
         ", work that excludes each other " +
         limit([](const Limits& l) { return l.bound.excluding_s; }) + ". Optimum between " +
         limit([](const Limits& l) { return l.optimum.least_s; }) + " and " +
         limit([](const Limits& l) { return l.optimum.most_s; }) +
         (any.front()->busy.size() > 2 ? " (of the pair that needs most: a bound)" : "") + ".\n\n";
}

}  // namespace

std::string fixed(double number, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, number);
  return text;
}

std::vector<const RunRow*> rows_of(const std::vector<RunRow>& rows, const std::string& workload,
                                   const std::string& policy) {
  std::vector<const RunRow*> found;
  for (const RunRow& row : rows) {
    if (row.workload == workload && row.policy == policy) found.push_back(&row);
  }
  return found;
}

std::vector<std::string> policies_of(const std::vector<RunRow>& rows, const std::string& workload) {
  std::vector<std::string> policies;
  for (const RunRow& row : rows) {
    if (row.workload != workload) continue;
    if (std::ranges::find(policies, row.policy) == policies.end()) policies.push_back(row.policy);
  }
  return policies;
}

Spread spread_of(const std::vector<const RunRow*>& rows, double RunRow::*figure) {
  std::vector<double> values;
  for (const RunRow* row : rows) values.push_back(row->*figure);
  return spread_of(values);
}

std::vector<double> of_optimum(const std::vector<const RunRow*>& rows) {
  std::vector<double> ratios;
  for (const RunRow* row : rows) ratios.push_back(row->makespan_s / row->limits.optimum.least_s);
  return ratios;
}

double mean_bound_s(const std::vector<const RunRow*>& rows) {
  return mean(rows, [](const RunRow& row) { return row.limits.bound.bound_s(); });
}

std::string results_csv(const std::vector<RunRow>& rows) {
  std::string text =
      "workload,seed,policy,jobs,not_succeeded,makespan_s,own_work_s,excluding_work_s,"
      "lower_bound_s,optimum_s,optimum_at_most_s,busy_ratio,least_busy_ratio,together_ratio,wait_"
      "mean_s,"
      "wait_max_s,"
      "held_mean_s,min_clearance_m,monitor_stops,backlogged,judgements,evaluations\n";
  for (const RunRow& row : rows) {
    text += joined({row.workload,
                    std::to_string(row.seed),
                    row.policy,
                    std::to_string(row.jobs),
                    std::to_string(row.not_succeeded),
                    fixed(row.makespan_s, 3),
                    fixed(row.limits.bound.own_s, 3),
                    fixed(row.limits.bound.excluding_s, 3),
                    fixed(row.limits.bound.bound_s(), 3),
                    fixed(row.limits.optimum.least_s, 3),
                    fixed(row.limits.optimum.most_s, 3),
                    fixed(busy(row), 6),
                    fixed(*std::ranges::min_element(row.busy), 6),
                    fixed(row.together, 6),
                    fixed(row.wait_mean_s, 6),
                    fixed(row.wait_max_s, 3),
                    fixed(row.held_mean_s, 6),
                    std::isfinite(row.clearance_m) ? fixed(row.clearance_m, 6) : "",
                    std::to_string(row.monitor_stops),
                    std::to_string(row.backlogged),
                    std::to_string(row.judgements),
                    std::to_string(row.evaluations)},
                   ",") +
            "\n";
  }
  return text;
}

std::string results_markdown(const Plan& plan, const std::vector<RunRow>& rows) {
  std::string text = "# Results\n\nMade by `test/experiments/run`; means over " +
                     std::to_string(plan.seeds) +
                     " seeds. [README.md](../README.md) says what the workloads and columns are.\n";
  for (const WorkloadKind& kind : plan.workloads) {
    const std::vector<std::string> policies = policies_of(rows, kind.name);
    if (policies.empty()) continue;
    const Rows any = rows_of(rows, kind.name, policies.back());
    text += workload_heading(kind, any);
    const std::vector<std::string> heading = {"policy",
                                              "makespan, s",
                                              "of sequential",
                                              "of lower bound",
                                              "of optimum",
                                              "worst of optimum",
                                              "arms in use",
                                              "two or more move",
                                              "mean wait, s",
                                              "longest wait, s",
                                              "held, s",
                                              "backlogged",
                                              "judgements beyond the first",
                                              "evaluations per job",
                                              "smallest clearance, mm",
                                              "monitor stops",
                                              "succeeded"};
    text += table_row(heading) + rule(heading.size());
    const Rows sequential = rows_of(rows, kind.name, "sequential");
    const double sequential_s =
        sequential.empty() ? 0.0 : spread_of(sequential, &RunRow::makespan_s).mean;
    for (const std::string& policy : policies) {
      text += policy_row(policy, rows_of(rows, kind.name, policy), sequential_s);
    }
  }
  return text;
}

std::string decision_times_markdown(const Plan& plan, const std::vector<RunRow>& rows) {
  std::string text =
      "# What deciding took\n\nMilliseconds of one core per job, all judgements of the job "
      "together: mean over the seeds, and\nthe largest mean of a seed. Of the machine that "
      "`test/experiments/run` ran on; everything in\n[table.md](table.md) repeats anywhere.\n\n";
  std::vector<std::string> heading = {"workload"};
  heading.insert(heading.end(), plan.policies.begin(), plan.policies.end());
  text += table_row(heading) + rule(heading.size());
  const auto ms = [](const RunRow& row) {
    return row.judging_s * 1e3 / static_cast<double>(row.jobs);
  };
  for (const WorkloadKind& kind : plan.workloads) {
    std::vector<std::string> cells = {kind.name};
    for (const std::string& policy : plan.policies) {
      const Rows of_policy = rows_of(rows, kind.name, policy);
      double most = 0.0;
      for (const RunRow* row : of_policy) most = std::max(most, ms(*row));
      cells.push_back(fixed(mean(of_policy, ms), 2) + " (" + fixed(most, 2) + ")");
    }
    text += table_row(cells);
  }
  return text;
}

}  // namespace armloom::experiments
