#pragma once

#include <string>

#include "test/experiments/run_all.h"

namespace armloom::experiments {

// The rows of one policy in one workload.
[[nodiscard]] std::vector<const RunRow*> rows_of(const std::vector<RunRow>& rows,
                                                 const std::string& workload,
                                                 const std::string& policy);
// The policies that have rows in a workload, in order.
[[nodiscard]] std::vector<std::string> policies_of(const std::vector<RunRow>& rows,
                                                   const std::string& workload);
[[nodiscard]] Spread spread_of(const std::vector<const RunRow*>& rows, double RunRow::*figure);
// Of each row: makespan over optimum.
[[nodiscard]] std::vector<double> of_optimum(const std::vector<const RunRow*>& rows);
[[nodiscard]] double mean_bound_s(const std::vector<const RunRow*>& rows);
[[nodiscard]] std::string fixed(double number, int decimals);

// One line a run, RFC 4180 with "\n", names first; without times of the machine.
[[nodiscard]] std::string results_csv(const std::vector<RunRow>& rows);
// One table a workload, a row for each policy: means over the seeds, without times of the machine.
[[nodiscard]] std::string results_markdown(const Plan& plan, const std::vector<RunRow>& rows);
// What deciding took on this machine, per job.
[[nodiscard]] std::string decision_times_markdown(const Plan& plan,
                                                  const std::vector<RunRow>& rows);

}  // namespace armloom::experiments
