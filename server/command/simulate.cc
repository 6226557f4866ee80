#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <set>

#include "core/executive/simulation.h"
#include "server/codec/fault_codec.h"
#include "server/codec/job_codec.h"
#include "server/codec/json_writer.h"
#include "server/codec/problem_codec.h"
#include "server/codec/views.h"
#include "server/command/command.h"
#include "server/recording/recording.h"

namespace armloom {
namespace {

// Writes the recording, and counts what the figures do not say.
class Watcher final : public Observer {
 public:
  Watcher(Recording* recording, std::string stream)
      : recording_(recording), stream_(std::move(stream)) {}

  void on_event(const Event& event) override {
    if (const auto* job = std::get_if<JobView>(&event.body)) {
      if (job->state == JobState::backlogged) backlogged_.insert(job->key);
    }
    if (recording_ != nullptr) recording_->event(event_json(event, stream_, nullptr));
  }
  void on_tick(TimePoint now, const Configuration& measured) override {
    if (recording_ != nullptr) recording_->state(now, measured);
  }
  void on_state(const StateFrame&) override {}

  [[nodiscard]] std::size_t backlogged() const { return backlogged_.size(); }

 private:
  Recording* recording_;
  std::string stream_;
  std::set<std::string> backlogged_;
};

// Problems that no order of events can cure, found before anything runs.
Problems faults_of(const std::vector<TimedJob>& jobs, const Cell& cell) {
  Problems faults;
  std::set<std::string> keys;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const std::string place = "/" + std::to_string(i) + "/job";
    const std::string& key = jobs[i].job.key;
    if (!key.empty() && !keys.insert(key).second) {
      faults.push_back(Problem{ProblemKind::conflict, "id-in-use", place + "/id",
                               "the id is used by an earlier job of the file", key});
    }
    if (const auto trajectory = validate(jobs[i].job.trajectory, cell); !trajectory) {
      for (Problem problem : trajectory.error()) {
        problem.pointer = place + "/trajectory" + problem.pointer;
        faults.push_back(std::move(problem));
      }
    }
  }
  return faults;
}

// After this much cell time something is wrong: every job has waited as long as it may and run as
// long as it may, one after the other.
TimePoint time_limit(const std::vector<TimedJob>& jobs, const std::vector<FaultRequest>& faults,
                     const Cell& cell) {
  double limit_s = 60.0;
  double last_s = 0.0;
  for (const FaultRequest& fault : faults) {
    limit_s += to_seconds(fault.lasting.value_or(Duration{}));
  }
  for (const TimedJob& timed : jobs) {
    const auto& points = timed.job.trajectory.points;
    const double duration_s = points.empty() ? 0.0 : points.back().time_from_start_s;
    limit_s += to_seconds(timed.job.backlog_timeout.value_or(cell.scheduling.backlog_timeout)) +
               duration_s * cell.execution.duration_scaling +
               to_seconds(cell.execution.duration_margin);
    last_s = std::max(last_s, to_seconds(timed.at));
  }
  return at(from_seconds(last_s + limit_s));
}

struct Summary {
  std::string policy;
  Duration makespan{};
  std::map<std::string, std::size_t> jobs;
  std::size_t backlogged = 0;
  Duration wait_mean{};
  Duration wait_max{};
};

Summary summarise(const SimulationResult& result, TimePoint first_submit) {
  Summary summary;
  for (const JobState state : {JobState::succeeded, JobState::canceled, JobState::expired,
                               JobState::failed, JobState::interrupted}) {
    summary.jobs[to_string(state)] = 0;
  }
  summary.jobs["refused"] = result.refused.size();
  std::int64_t started = 0;
  Duration wait_sum{};
  for (const JobView& job : result.jobs) {
    ++summary.jobs[to_string(job.state)];
    if (!job.started_at) continue;
    const Duration wait = *job.started_at - job.submitted_at;
    ++started;
    wait_sum += wait;
    summary.wait_max = std::max(summary.wait_max, wait);
  }
  if (started > 0) summary.wait_mean = wait_sum / started;
  if (started > 0) summary.makespan = result.figures.last_end - first_submit;
  return summary;
}

std::string summary_json(const Summary& summary, const SimulationResult& result, const Cell& cell,
                         double wall_s) {
  JsonWriter out;
  out.begin_object().field("policy", summary.policy).field("makespan_s", summary.makespan);
  out.key("jobs").begin_object();
  for (const auto& [state, count] : summary.jobs) out.field(state, count);
  out.end_object().field("backlogged", summary.backlogged).key("arm_busy_ratio").begin_object();
  for (std::size_t arm = 0; arm < cell.arms.size(); ++arm) {
    const double busy_s = to_seconds(result.figures.busy[arm]);
    const double whole_s = to_seconds(summary.makespan);
    out.key(cell.arms[arm].name).rounded(whole_s > 0.0 ? busy_s / whole_s : 0.0, 6);
  }
  out.end_object().key("wait_s").begin_object().field("mean", summary.wait_mean);
  out.field("max", summary.wait_max).end_object();
  out.field("min_clearance_m", result.figures.min_clearance_m);
  out.field("monitor_stops", result.figures.monitor_stops);
  out.field("wall_s", wall_s).end_object();
  return out.take();
}

void complain_of_refusals(const SimulationResult& result, const std::string& jobs_file) {
  for (const auto& refused : result.refused) {
    for (Problem problem : refused.problems) {
      problem.pointer = "/" + std::to_string(refused.index) + "/job" + problem.pointer;
      complain(jobs_file, {problem});
    }
  }
}

}  // namespace

int simulate_jobs(const SimulateOptions& options) {
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  const Cell& cell = *loaded->cell;
  const auto refuse = [](const std::string& file, const Problems& problems) {
    complain(file, problems);
    return kExitBadInput;
  };
  const auto text = read_text_file(options.jobs_file);
  if (!text) return refuse(options.jobs_file, text.error());
  auto jobs = read_jobs_text(*text);
  if (!jobs) return refuse(options.jobs_file, jobs.error());
  if (const Problems faults = faults_of(*jobs, cell); !faults.empty()) {
    return refuse(options.jobs_file, faults);
  }
  std::vector<FaultRequest> faults;
  if (!options.faults_file.empty()) {
    const auto faults_text = read_text_file(options.faults_file);
    if (!faults_text) return refuse(options.faults_file, faults_text.error());
    auto read = read_faults_text(*faults_text, cell);
    if (!read) return refuse(options.faults_file, read.error());
    faults = std::move(*read);
  }
  std::unique_ptr<Recording> recording;
  if (!options.out.empty()) {
    auto created = Recording::create(options.out, {loaded->file, loaded->text}, cell, true);
    if (!created) {
      return refuse(options.cell_file,
                    said_of_option(std::move(created.error()), "cannot-write", "--out"));
    }
    recording = std::move(*created);
    recording->jobs_file(*text);
  }

  TimePoint first_submit = TimePoint::max();
  for (const TimedJob& timed : *jobs) first_submit = std::min(first_submit, timed.at);
  const TimePoint limit = time_limit(*jobs, faults, cell);
  ExecutiveOptions executive_options;
  executive_options.policy = options.policy;
  executive_options.seed = options.seed;
  Watcher watcher(recording.get(), stream_of_seed(options.seed));
  const auto wall_start = std::chrono::steady_clock::now();
  auto result = simulate(loaded->cell, executive_options, std::move(*jobs), limit, watcher, faults);
  if (!result) {
    Problems problems = std::move(result.error());
    if (!options.policy.empty()) {
      problems = said_of_option(std::move(problems), "unknown-policy", "--policy");
    }
    return refuse(options.cell_file, problems);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_start;

  complain_of_refusals(*result, options.jobs_file);
  if (recording != nullptr && !recording->good()) {
    return refuse("", {Problem{ProblemKind::unavailable, "cannot-write", "--out",
                               "the recording could not be written whole", options.out}});
  }
  Summary summary = summarise(*result, first_submit);
  summary.policy = options.policy.empty() ? cell.scheduling.policy : options.policy;
  summary.backlogged = watcher.backlogged();
  std::cout << summary_json(summary, *result, cell, wall.count()) << std::endl;
  return result->all_ended && result->refused.empty() ? kExitDone : kExitFound;
}

}  // namespace armloom
