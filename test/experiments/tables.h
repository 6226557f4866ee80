#pragma once

#include <string>

#include "test/experiments/run_all.h"

namespace armloom::experiments {

[[nodiscard]] std::vector<const RunRow*> rows_of(const std::vector<RunRow>& rows,
                                                 const std::string& workload,
                                                 const std::string& policy);
[[nodiscard]] std::vector<std::string> policies_of(const std::vector<RunRow>& rows,
                                                   const std::string& workload);
[[nodiscard]] Spread spread_of(const std::vector<const RunRow*>& rows, double RunRow::*figure);
// Makespan over optimum of each row.
[[nodiscard]] std::vector<double> of_optimum(const std::vector<const RunRow*>& rows);
[[nodiscard]] double mean_bound_s(const std::vector<const RunRow*>& rows);
[[nodiscard]] std::string fixed(double number, int decimals);

// One line per run, RFC 4180 with "\n", header first; without machine times.
[[nodiscard]] std::string results_csv(const std::vector<RunRow>& rows);
// One table per workload, a row for each policy: means over the seeds, without machine times.
[[nodiscard]] std::string results_markdown(const Plan& plan, const std::vector<RunRow>& rows);
// Decision times on this machine, per job.
[[nodiscard]] std::string decision_times_markdown(const Plan& plan,
                                                  const std::vector<RunRow>& rows);

}  // namespace armloom::experiments
