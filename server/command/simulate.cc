#include <iostream>
#include <set>

#include "core/executive/simulation.h"
#include "server/codec/json_writer.h"
#include "server/codec/stream_id.h"
#include "server/command/command.h"
#include "server/command/headless.h"
#include "server/command/progress.h"
#include "server/messages/events.h"
#include "server/messages/fault.h"
#include "server/recording/recording.h"

namespace armloom {
namespace {

// Writes the recording and counts backlogged jobs.
class Watcher final : public Observer {
 public:
  Watcher(Recording* recording, std::string stream, Progress& progress)
      : recording_(recording), stream_(std::move(stream)), progress_(progress) {}

  void on_event(const Event& event) override {
    if (const auto* job = std::get_if<JobView>(&event.body)) {
      if (job->state == JobState::backlogged) backlogged_.insert(job->key);
    }
    if (recording_ != nullptr) recording_->event(event_json(event, stream_, nullptr));
  }
  void on_tick(TimePoint now, const Configuration& measured) override {
    progress_.cell_time(to_seconds(now));
    if (recording_ != nullptr) recording_->state(now, measured);
  }
  void on_truth(TimePoint now, const Configuration& positions) override {
    if (recording_ != nullptr) recording_->truth(now, positions);
  }
  void on_rest(bool at_rest) override {
    if (recording_ != nullptr) recording_->at_rest(at_rest);
  }
  void on_state(const StateFrame&) override {}

  [[nodiscard]] std::size_t backlogged() const { return backlogged_.size(); }

 private:
  Recording* recording_;
  std::string stream_;
  Progress& progress_;
  std::set<std::string> backlogged_;
};

std::string summary_json(const std::string& policy, std::size_t backlogged,
                         const RunSummary& summary, const SimulationResult& result,
                         const Cell& cell) {
  JsonWriter out;
  out.begin_object().field("policy", policy).field("makespan_s", summary.makespan);
  out.key("jobs").begin_object();
  for (const auto& [state, count] : summary.jobs) out.field(state, count);
  out.end_object().field("backlogged", backlogged).key("arm_busy_ratio").begin_object();
  for (std::size_t arm = 0; arm < cell.arms.size(); ++arm) {
    const double busy_s = to_seconds(result.figures.busy[arm]);
    const double whole_s = to_seconds(summary.span);
    out.key(cell.arms[arm].name).rounded(whole_s > 0.0 ? busy_s / whole_s : 0.0, 6);
  }
  out.end_object().key("wait_s").begin_object().field("mean", summary.wait_mean);
  out.field("max", summary.wait_max).end_object();
  out.field("min_clearance_m", result.figures.min_clearance_m);
  out.field("monitor_stops", result.figures.monitor_stops);
  out.field("guard_refusals", result.figures.guard_refusals);
  out.field("wall_s", result.wall).end_object();
  return out.take();
}

}  // namespace

int simulate_jobs(const SimulateOptions& options) {
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  const Cell& cell = *loaded->cell;
  auto jobs = load_jobs(options.jobs_file, cell);
  if (!jobs) return kExitBadInput;
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
    recording->jobs_file(jobs->text);
  }

  const TimePoint first_submit = jobs->first_submit();
  const TimePoint limit = time_limit(jobs->jobs, faults, cell);
  ExecutiveOptions executive_options;
  executive_options.policy = options.policy;
  executive_options.seed = options.seed;
  std::optional<Progress> progress(std::in_place, "simulate");
  Watcher watcher(recording.get(), stream_of_seed(options.seed), *progress);
  auto result = simulate(loaded->cell, executive_options,
                         {std::move(jobs->jobs), limit, std::move(faults)}, watcher);
  progress.reset();
  if (!result) {
    Problems problems = std::move(result.error());
    if (!options.policy.empty()) {
      problems = said_of_option(std::move(problems), "unknown-policy", "--policy");
    }
    return refuse(options.cell_file, problems);
  }

  complain_of_refusals(*result, options.jobs_file);
  complain_of_ends(*result);
  if (recording != nullptr) recording->close();
  if (const auto fault = recording != nullptr ? recording->fault() : std::nullopt) {
    return refuse(
        "", {Problem{ProblemKind::unavailable, "cannot-write", "--out",
                     "the recording could not be written completely: " + *fault, options.out}});
  }
  const std::string& policy = options.policy.empty() ? cell.scheduling.policy : options.policy;
  std::cout << summary_json(policy, watcher.backlogged(), summarise(*result, first_submit), *result,
                            cell)
            << std::endl;
  return result->all_ended && result->refused.empty() ? kExitDone : kExitFound;
}

}  // namespace armloom
