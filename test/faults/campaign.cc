// The fault campaign: every fault of listed_faults.cc, with many seeds. Prints a table; exit 1 if a
// promise was broken. See README.md.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>

#include "test/faults/fault_run.h"

namespace armloom {
namespace {

const std::vector<std::string> kPolicies{"coordinated", "earliest_start", "certified",
                                         "reservation", "lockstep",       "sequential"};

struct Options {
  std::string fault;   // all if empty
  std::string policy;  // by seed if empty
  std::uint64_t seeds = 100, first = 1;
  bool monitored = true, tasks = false, verbose = false;
  double hours = 0.0;  // above zero: long runs instead of the list
  bool faulty = true;
};

struct Row {
  std::size_t runs = 0, contacts = 0, possible = 0, jobs = 0, succeeded = 0, waiting = 0,
              silent = 0, lost = 0;                          // lost: runs
  std::size_t stops = 0, stops_of_faulty = 0, needless = 0;  // needless: runs
  double closest_m = 1e9, simulated_s = 0.0, cpu_s = 0.0;
  std::uint64_t refusals = 0;

  Row& operator+=(const Row& other) {
    runs += other.runs, contacts += other.contacts, possible += other.possible, jobs += other.jobs;
    succeeded += other.succeeded, waiting += other.waiting, silent += other.silent,
        lost += other.lost;
    stops += other.stops, stops_of_faulty += other.stops_of_faulty, needless += other.needless;
    closest_m = std::min(closest_m, other.closest_m);
    simulated_s += other.simulated_s, cpu_s += other.cpu_s, refusals += other.refusals;
    return *this;
  }
};

void print_head() {
  std::printf(
      "| fault | runs | contacts | by faults that may touch | closest mm | jobs | succeeded | "
      "waiting | silent | "
      "stops of faulty arms | of others | runs with needless stops | guard refusals | "
      "hours | hours per hour of processor time |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
}

void print(const std::string& name, const Row& row) {
  std::printf(
      "| %s | %zu | %zu | %zu | %.2f | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %.2f | "
      "%.0f |\n",
      name.c_str(), row.runs, row.contacts, row.possible, 1000 * row.closest_m, row.jobs,
      row.succeeded, row.waiting, row.silent, row.stops_of_faulty, row.stops, row.needless,
      static_cast<std::size_t>(row.refusals), row.simulated_s / 3600, row.simulated_s / row.cpu_s);
  std::fflush(stdout);
}

Row run(const FaultRunPlan& plan, const Options& options) {
  const std::clock_t begun = std::clock();
  const FaultRunResult result = run_with_faults(plan);
  Row row{.runs = 1,
          .contacts = result.contact && !result.may_touch ? 1U : 0U,
          .possible = result.contact && result.may_touch ? 1U : 0U,
          .jobs = result.jobs,
          .succeeded = result.succeeded,
          .waiting = result.waiting,
          .silent = result.silent.size(),
          .lost = result.lost.empty() ? 0U : 1U,
          .stops = result.stops.size(),
          .stops_of_faulty = result.stops_of_faulty,
          .closest_m = result.closest_m,
          .simulated_s = to_seconds(result.simulated),
          .refusals = result.guard_refusals};
  row.cpu_s = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
  // Only the first stop: after it, the runs with and without the monitor differ.
  if (!result.stops.empty() && plan.monitored) {
    const double distance_m = distance_without_monitor(plan, result.stops.front());
    row.needless = distance_m > kEndangered_m ? 1 : 0;
    if (row.needless > 0) {
      std::fprintf(stderr, "needless: %s seed %llu %s at %.3f s: %s stays %.0f mm away\n",
                   plan.policy.c_str(), static_cast<unsigned long long>(plan.seed),
                   plan.fault ? plan.fault->name.c_str() : "any",
                   to_seconds(result.stops.front().time), result.stops.front().why.c_str(),
                   1000 * distance_m);
    }
  }
  const char* fault = plan.fault != nullptr ? plan.fault->name.c_str() : "any";
  const auto seed = static_cast<unsigned long long>(plan.seed);
  if (result.contact && (plan.monitored || options.verbose)) {
    std::fprintf(stderr, "contact: %s seed %llu %s at %.3f s: %s and %s\n", plan.policy.c_str(),
                 seed, fault, to_seconds(result.contact->time), result.contact->body_a.c_str(),
                 result.contact->body_b.c_str());
  }
  for (const std::string& part : result.lost) {
    std::fprintf(stderr, "lost: %s seed %llu %s: %s\n", plan.policy.c_str(), seed, fault,
                 part.c_str());
  }
  for (const std::string& job : result.silent) {
    std::fprintf(stderr, "silent: %s seed %llu %s: %s\n", plan.policy.c_str(), seed, fault,
                 job.c_str());
  }
  return row;
}

FaultRunPlan plan_of(std::uint64_t seed, const Options& options) {
  return {.seed = seed,
          .world = seed % 5 == 0 ? RandomWorld::pandas : RandomWorld::sliders,
          .policy = options.policy.empty() ? kPolicies[seed % kPolicies.size()] : options.policy,
          .faulty = options.faulty,
          .monitored = options.monitored,
          .tasks = options.tasks,
          .verbose = options.verbose};
}

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

// Random faults, or none, for many hours.
Row run_hours(const Options& options) {
  Row all;
  for (std::uint64_t seed = options.first; all.simulated_s < 3600 * options.hours; ++seed) {
    FaultRunPlan plan = plan_of(seed, options);
    plan.jobs_for = std::chrono::minutes(30);
    plan.open_max = 40;
    const Row row = run(plan, options);
    all += row;
    print("seed " + std::to_string(seed) + ", " + plan.policy + ", " +
              std::to_string(static_cast<int>(resident_mb())) + " MB",
          row);
  }
  return all;
}

Row run_list(const Options& options) {
  Row all;
  for (const ListedFault& fault : listed_faults()) {
    if (!options.fault.empty() && options.fault != fault.name) continue;
    Row sum;
    for (std::uint64_t seed = options.first; seed < options.first + options.seeds; ++seed) {
      FaultRunPlan plan = plan_of(seed, options);
      plan.fault = &fault;
      sum += run(plan, options);
    }
    print(fault.name, sum);
    all += sum;
  }
  return all;
}

int campaign(const Options& options) {
  print_head();
  const Row all = options.hours > 0.0 ? run_hours(options) : run_list(options);
  if (all.runs == 0) {
    std::fprintf(stderr, "unknown fault \"%s\": --list prints the faults\n", options.fault.c_str());
    return 2;
  }
  print("all", all);
  const bool calm = options.faulty || all.stops + all.stops_of_faulty == 0;
  const bool few = 100 * all.needless <= all.runs;
  return all.contacts == 0 && all.silent == 0 && all.lost == 0 && few && calm ? 0 : 1;
}

}  // namespace
}  // namespace armloom

int main(int count, char** words) {
  armloom::Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const auto value = [&]() -> std::string { return i + 1 < count ? words[++i] : ""; };
    if (word == "--list") {
      std::cout << armloom::table_of_faults();
      return 0;
    }
    if (word == "--fault") {
      options.fault = value();
    } else if (word == "--policy") {
      options.policy = value();
    } else if (word == "--seeds") {
      options.seeds = std::strtoull(value().c_str(), nullptr, 10);
    } else if (word == "--first-seed") {
      options.first = std::strtoull(value().c_str(), nullptr, 10);
    } else if (word == "--hours") {
      options.hours = std::strtod(value().c_str(), nullptr);
    } else if (word == "--no-faults") {
      options.faulty = false;
    } else if (word == "--monitor-off") {
      options.monitored = false;
    } else if (word == "--tasks") {
      options.tasks = true;
    } else if (word == "--verbose") {
      options.verbose = true;
    } else {
      std::fprintf(
          stderr,
          "usage: fault_campaign [--list] [--fault NAME] [--policy NAME] [--seeds N] "
          "[--first-seed N] [--hours H [--no-faults]] [--monitor-off] [--tasks] [--verbose]\n");
      return 2;
    }
  }
  return armloom::campaign(options);
}
