// experiments [--seeds N] [--threads N] [--workloads a,b] [--policies a,b] --out DIR
// Runs the experiments and writes results.csv, table.md, decision_times.md and the plots. Exit code
// 0: all claims hold; 1: a claim does not hold; 2: bad arguments, or a run was not possible.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>
#include <thread>

#include "core/executive/known_policies.h"
#include "test/experiments/charts.h"
#include "test/experiments/claims.h"
#include "test/experiments/tables.h"

namespace armloom::experiments {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::map<std::string, std::string> options_of(int argc, char** argv) {
  std::map<std::string, std::string> options = {
      {"--seeds", "20"}, {"--threads", ""}, {"--workloads", ""}, {"--policies", ""}, {"--out", ""}};
  for (int i = 1; i < argc; i += 2) {
    const auto found = options.find(argv[i]);
    if (found == options.end() || i + 1 == argc) {
      throw std::invalid_argument(std::string("not understood: ") + argv[i]);
    }
    found->second = argv[i + 1];
  }
  if (options["--out"].empty()) throw std::invalid_argument("--out DIR is missing");
  return options;
}

Plan plan_of(const std::map<std::string, std::string>& options) {
  Plan plan;
  plan.seeds = std::stoull(options.at("--seeds"));
  if (plan.seeds == 0) throw std::invalid_argument("--seeds must be 1 or more");
  plan.threads = options.at("--threads").empty()
                     ? std::max(1U, std::thread::hardware_concurrency())
                     : static_cast<unsigned>(std::stoul(options.at("--threads")));
  plan.policies =
      options.at("--policies").empty() ? known_policies() : split(options.at("--policies"));
  plan.workloads = workload_kinds();
  if (options.at("--workloads").empty()) return plan;
  plan.workloads.clear();
  for (const std::string& name : split(options.at("--workloads"))) {
    const auto kind = std::ranges::find(workload_kinds(), name, &WorkloadKind::name);
    if (kind == workload_kinds().end()) throw std::invalid_argument("no workload " + name);
    plan.workloads.push_back(*kind);
  }
  return plan;
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

int experiments(int argc, char** argv) {
  const auto options = options_of(argc, argv);
  const Plan plan = plan_of(options);
  const fs::path folder = options.at("--out");
  fs::create_directories(folder);
  const Results results = run_all(plan);

  const std::string table = results_markdown(plan, results.rows);
  write(folder / "results.csv", results_csv(results.rows));
  write(folder / "table.md", table);
  write(folder / "decision_times.md", decision_times_markdown(plan, results.rows));
  for (const WorkloadKind& kind : plan.workloads) {
    write(folder / ("makespan_" + kind.name + ".svg"), makespan_svg(kind, results.rows));
  }
  std::cout << table << '\n';

  bool all_hold = true;
  for (const Claim& claim : claims(plan, results.rows, plan.policies.back())) {
    std::cout << (claim.holds ? "holds: " : "does not hold: ") << claim.sentence << '\n';
    all_hold = all_hold && claim.holds;
  }
  return all_hold ? 0 : 1;
}

}  // namespace
}  // namespace armloom::experiments

int main(int argc, char** argv) {
  try {
    return armloom::experiments::experiments(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "experiments: " << error.what() << '\n';
    return 2;
  }
}
