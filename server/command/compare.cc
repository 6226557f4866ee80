#include <algorithm>
#include <fstream>
#include <iostream>

#include "core/executive/known_policies.h"
#include "server/command/command.h"
#include "server/command/compare_report.h"
#include "server/command/headless.h"
#include "server/command/progress.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

class ShowsTime final : public Observer {
 public:
  explicit ShowsTime(Progress& progress) : progress_(progress) {}
  void on_event(const Event&) override {}
  void on_tick(TimePoint now, const Configuration&) override {
    progress_.cell_time(to_seconds(now));
  }
  void on_state(const StateFrame&) override {}

 private:
  Progress& progress_;
};

// Reads "a,b". Problems: an unknown or repeated name.
Result<std::vector<std::string>> read_policies(const std::string& text) {
  if (text.empty()) return known_policies();
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    std::string name = text.substr(begin, end - begin);
    begin = end + 1;
    if (auto problems = policy_problems(name)) {
      return failure(said_of_option(*std::move(problems), "unknown-policy", "--policies"));
    }
    if (std::ranges::find(names, name) != names.end()) {
      return failure(Problem{ProblemKind::invalid, "twice", "--policies",
                             "policy \"" + name + "\" is listed twice: remove one", name});
    }
    names.push_back(std::move(name));
  }
  return names;
}

// Return the planned time in motion of each arm: over all jobs of the file, and over all jobs that
// succeeded.
std::vector<Duration> work_of_file(const JobsFile& file, const Cell& cell) {
  std::vector<Duration> work(cell.arms.size());
  for (const TrajectoryPtr& trajectory : file.trajectories) {
    for (const ArmId arm : trajectory->arms()) work[arm.index()] += trajectory->duration();
  }
  return work;
}
std::vector<Duration> work_done(const SimulationResult& result, const Cell& cell) {
  std::vector<Duration> work(cell.arms.size());
  for (const JobView& job : result.jobs) {
    if (job.state != JobState::succeeded || job.system_job) continue;
    for (const std::string& arm : job.arms)
      work[cell.find_arm(arm)->index()] += job.motion.duration;
  }
  return work;
}

Result<ComparedRun> run(const std::string& policy, const CellPtr& cell, const JobsFile& file,
                        const CompareOptions& options, Progress& progress) {
  ExecutiveOptions executive_options;
  executive_options.policy = policy;
  executive_options.seed = options.seed;
  ShowsTime shows_time(progress);
  auto result =
      simulate(cell, executive_options, {file.jobs, time_limit(file.jobs, {}, *cell)}, shows_time);
  if (!result) return failure(std::move(result.error()));

  complain_of_refusals(*result, options.jobs_file, policy);
  complain_of_ends(*result, policy);
  return ComparedRun{.policy = policy,
                     .summary = summarise(*result, file.first_submit()),
                     .figures = result->figures,
                     .judging = result->judging,
                     .all_ended = result->all_ended,
                     .least = std::ranges::max(work_done(*result, *cell)),
                     .wall = result->wall};
}

// The output files. They are opened before the simulation and written after it.
struct Files {
  std::ofstream csv;
  std::ofstream svg;
};
Result<Files> open_files(const std::string& folder) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  Files files{std::ofstream(fs::path(folder) / "compare.csv", std::ios::binary),
              std::ofstream(fs::path(folder) / "compare.svg", std::ios::binary)};
  if (files.csv && files.svg) return files;
  return failure(Problem{ProblemKind::unavailable, "cannot-write", "--out",
                         "the folder " + folder + " cannot be written", folder});
}

}  // namespace

int compare_policies(const CompareOptions& options) {
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  const Cell& cell = *loaded->cell;
  note_simulated_robots(cell);
  const auto policies = read_policies(options.policies);
  if (!policies) return refuse("", policies.error());
  const auto jobs = load_jobs(options.jobs_file, cell);
  if (!jobs) return kExitBadInput;
  std::optional<Files> files;
  if (!options.out.empty()) {
    auto opened = open_files(options.out);
    if (!opened) return refuse("", opened.error());
    files = std::move(*opened);
  }

  Comparison comparison{.cell = cell.name, .jobs = jobs->jobs.size(), .seed = options.seed};
  for (const Arm& arm : cell.arms) comparison.arms.push_back(arm.name);
  const std::vector<Duration> work = work_of_file(*jobs, cell);
  const auto most = std::ranges::max_element(work);
  if (*most > Duration{}) {
    comparison.busiest = cell.arms[static_cast<std::size_t>(most - work.begin())].name;
    comparison.busiest_work = *most;
  }
  bool all_ended = true;
  std::optional<Progress> progress(std::in_place, "compare");
  for (const std::string& policy : *policies) {
    progress->part(comparison.runs.size() + 1, policies->size());
    auto compared = run(policy, loaded->cell, *jobs, options, *progress);
    if (!compared) return refuse(options.cell_file, compared.error());
    all_ended = all_ended && compared->all_ended && compared->summary.jobs.at("refused") == 0;
    comparison.runs.push_back(std::move(*compared));
  }
  progress.reset();

  std::cout << comparison_markdown(comparison) << std::flush;
  if (files) {
    files->csv << comparison_csv(comparison) << std::flush;
    files->svg << comparison_svg(comparison) << std::flush;
    if (!files->csv || !files->svg) {
      return refuse("", {Problem{ProblemKind::unavailable, "cannot-write", "--out",
                                 "the files could not be written completely", options.out}});
    }
  }
  return all_ended ? kExitDone : kExitFound;
}

}  // namespace armloom
