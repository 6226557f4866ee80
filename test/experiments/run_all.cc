#include "test/experiments/run_all.h"

#include <atomic>
#include <exception>
#include <iostream>
#include <mutex>
#include <thread>

#include "test/experiments/fixed_orders.h"
#include "test/experiments/job_delays.h"

namespace armloom::experiments {
namespace {

constexpr Duration kMoment = std::chrono::milliseconds(50);  // sample step of the lower bound

Limits limits_of(const Workload& given) {
  std::vector<Work> work;
  for (const PlannedJob& job : given.jobs) {
    work.push_back({job.arm, job.delay ? as_delayed(*job.trajectory, *job.delay) : job.trajectory,
                    job.timed.at});
  }
  return {lower_bound(given.cell, work, kMoment), optimum(given.cell, work)};
}

std::vector<RunRow> run_seed(const WorkloadKind& kind, std::uint64_t seed,
                             const std::vector<std::string>& policies) {
  const Workload workload = kind.make(seed);
  const Workload given =
      kind.freed_from.empty() ? workload : workload_kind(kind.freed_from).make(seed);
  const Limits limits = kind.of_tasks ? Limits{} : limits_of(given);
  std::vector<RunRow> rows;
  if (!workload.one_arm.empty()) {
    rows.push_back(run_policy(workload, kind.name, kOneArm, seed, limits));
  }
  if (kind.delayed) {
    rows.push_back(run_policy(workload, kind.name, kFixedOrders, seed, limits));
  }
  for (const std::string& policy : policies) {
    rows.push_back(run_policy(workload, kind.name, policy, seed, limits));
  }
  return rows;
}

}  // namespace

Results run_all(const Plan& plan) {
  const std::size_t count = plan.workloads.size() * plan.seeds;
  std::vector<std::vector<RunRow>> done(count);
  std::vector<std::exception_ptr> thrown(count);
  std::atomic<std::size_t> next = 0;
  std::mutex talking;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      const WorkloadKind& kind = plan.workloads[i / plan.seeds];
      const std::uint64_t seed = 1 + i % plan.seeds;
      try {
        done[i] = run_seed(kind, seed, plan.policies);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
      const std::lock_guard lock(talking);
      std::cerr << kind.name << ", seed " << seed << (thrown[i] ? ": failed\n" : "\n");
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < plan.threads; ++i) threads.emplace_back(work);
  }
  Results results;
  for (std::size_t i = 0; i < count; ++i) {
    if (thrown[i]) std::rethrow_exception(thrown[i]);
    for (RunRow& row : done[i]) results.rows.push_back(std::move(row));
  }
  return results;
}

}  // namespace armloom::experiments
