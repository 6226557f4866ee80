#include "server/command/headless.h"

#include <algorithm>
#include <iostream>
#include <set>

#include "core/trajectory/implicit_start.h"
#include "core/trajectory/validate.h"
#include "server/command/command.h"
#include "server/messages/job_request.h"
#include "server/recording/recording.h"

namespace armloom {
namespace {

Problems read_trajectories(JobsFile& file, const Cell& cell) {
  Problems faults;
  std::set<std::string> keys;
  for (std::size_t i = 0; i < file.jobs.size(); ++i) {
    const std::string place = "/" + std::to_string(i) + "/job";
    const std::string& key = file.jobs[i].job.key;
    if (!key.empty() && !keys.insert(key).second) {
      faults.push_back(Problem{ProblemKind::conflict, "id-in-use", place + "/id",
                               "the id is already used by an earlier job of the file", key});
    }
    std::vector<TrajectoryPtr> motions;
    for (const auto& [where, asked] : file.jobs[i].job.motions()) {
      auto motion = validate_from(asked, cell, cell.home());
      if (motion) motions.push_back(std::move(*motion));
      // Only the run knows where a motion with an implicit start begins, and validates it.
      if (motion || has_implicit_start(asked, cell)) continue;
      for (Problem problem : motion.error()) {
        problem.pointer = place + where + problem.pointer;
        faults.push_back(std::move(problem));
      }
    }
    if (!motions.empty()) file.trajectories.push_back(std::move(motions.front()));
  }
  return faults;
}

// Returns, for example, ", waits for arm right". Omits a detail that `said` already contains.
std::string waits_for(const WaitView& wait, const std::string& said) {
  std::string text = std::string(", waits for ") + to_string(wait.kind);
  const bool names_arm = wait.kind == Wait::Kind::arm || wait.kind == Wait::Kind::stop;
  const std::string& name = names_arm ? wait.arm : wait.job;
  if (!name.empty()) text += " " + name;
  if (wait.kind == Wait::Kind::object && wait.links.size() == 2) text += " " + wait.links[1];
  if (said.find(wait.detail) == said.npos) text += " (" + wait.detail + ")";
  return text;
}

}  // namespace

TimePoint JobsFile::first_submit() const {
  TimePoint first = TimePoint::max();
  for (const TimedJob& timed : jobs) first = std::min(first, timed.at);
  return first;
}

std::optional<JobsFile> load_jobs(const std::string& file, const Cell& cell) {
  auto text = read_text_file(file);
  if (!text) {
    complain(file, text.error());
    return std::nullopt;
  }
  auto jobs = read_jobs_text(*text);
  if (!jobs) {
    complain(file, jobs.error());
    return std::nullopt;
  }
  JobsFile loaded{std::move(*text), std::move(*jobs), {}};
  if (const Problems faults = read_trajectories(loaded, cell); !faults.empty()) {
    complain(file, faults);
    return std::nullopt;
  }
  return loaded;
}

void note_simulated_robots(const Cell& cell) {
  for (const Robot& robot : cell.robots) {
    if (robot.controller.type != "remote") continue;
    std::cerr << "armloom: note: robot " << robot.name << " is simulated here: its controller at "
              << robot.controller.endpoint << " is not used\n";
  }
}

void complain_of_refusals(const SimulationResult& result, const std::string& jobs_file,
                          const std::string& under) {
  for (const auto& refused : result.refused) {
    for (Problem problem : refused.problems) {
      problem.pointer = "/" + std::to_string(refused.index) + "/job" + problem.pointer;
      if (!under.empty()) problem.detail += " (under " + under + ")";
      complain(jobs_file, {problem});
    }
  }
}

void complain_of_ends(const SimulationResult& result, const std::string& under) {
  const std::string begin = "armloom: " + (under.empty() ? "" : under + ": ");
  if (!result.all_ended) {
    std::cerr << begin
              << (result.settled ? "nothing can move any more" : "all time limits have passed")
              << " at " << to_seconds(result.ended_at) << " s, but not all jobs have ended\n";
  }
  for (const JobView& job : result.jobs) {
    if (job.state == JobState::succeeded || (job.system_job && is_terminal(job.state))) continue;
    std::string said = is_terminal(job.state) ? "" : "did not end; its state is ";
    said += to_string(job.state);
    if (!job.detail().empty()) said += ": " + job.detail();
    for (const WaitView& wait : job.waits_on) said += waits_for(wait, said);
    std::cerr << begin << "job " << job.key << " " << said << '\n';
  }
}

}  // namespace armloom
