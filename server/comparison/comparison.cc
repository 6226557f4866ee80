#include "server/comparison/comparison.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/executive/known_policies.h"
#include "core/executive/simulation.h"
#include "core/executive/validated.h"
#include "server/comparison/run_summary.h"
#include "server/messages/job_request.h"
#include "server/messages/problem.h"

namespace armloom {
namespace {

// Gives the calling thread the lowest priority. On Linux, this does not change other threads.
void give_way() {
  constexpr int kNicest = 19;
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNicest));
}

class Nobody final : public Observer {
 public:
  void on_event(const Event&) override {}
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}
};

// Returns the jobs for the simulation. A predecessor that is not among these jobs is taken as
// succeeded.
std::vector<TimedJob> timed_jobs(const std::vector<JobsAtHand::Job>& jobs, const Cell& cell) {
  std::vector<TimedJob> timed;
  std::set<std::string> keys;
  for (const JobsAtHand::Job& job : jobs) {
    auto request = read_job_text(*job.body);
    if (!request) continue;  // accepted jobs can be read
    validate_ahead(*request, cell);
    request->key = job.key;
    for (const std::string& before : request->after) {
      if (!keys.contains(before)) request->known.succeeded.push_back(before);
    }
    keys.insert(job.key);
    timed.push_back(
        {TimePoint{} + (job.submitted_at - jobs.front().submitted_at), std::move(*request)});
  }
  return timed;
}

// Returns the cell as the jobs found it, with the question's objects. If earlier jobs are left out,
// each arm is at the start of its first trajectory.
CellPtr cell_of(const Cell& cell, const Comparison::Question& question,
                const std::vector<TimedJob>& jobs) {
  const auto as_found = std::make_shared<Cell>(cell);
  as_found->objects = question.objects;
  if (question.taken.whole) return as_found;
  std::set<std::size_t> placed;
  for (const TimedJob& timed : jobs) {
    for (const Result<TrajectoryPtr>& motion : timed.job.known.validated) {
      if (!motion) continue;
      for (const ArmId arm : (*motion)->arms()) {
        if (!placed.insert(arm.index()).second) continue;
        Arm& moved = as_found->arms[arm.index()];
        const auto& joints = (*motion)->joints();
        for (std::size_t i = 0; i < moved.joints.size(); ++i) {
          const auto it = std::ranges::find(joints, moved.joints[i]);
          if (it == joints.end()) continue;
          moved.home[static_cast<Eigen::Index>(i)] = (*motion)->start()[it - joints.begin()];
        }
      }
    }
  }
  return as_found;
}

PolicyRun run_of(const SimulationResult& result) {
  const RunSummary summary = summarise(result, TimePoint{});
  const auto count = [&](const char* end) { return summary.jobs.at(end); };
  PolicyRun run;
  run.succeeded = count("succeeded");
  run.expired = count("expired");
  run.failed = count("failed");
  run.canceled = count("canceled") + count("interrupted");
  run.refused = count("refused");
  for (const JobView& job : result.jobs) {
    if (job.system_job) continue;
    if (!is_terminal(job.state)) ++run.unfinished;
    if (job.times.backlogged_at) ++run.backlogged;
  }
  if (result.all_ended && summary.makespan > Duration{}) run.makespan = summary.makespan;
  run.wait_mean = summary.wait_mean;
  run.wait_max = summary.wait_max;
  if (std::isfinite(result.figures.min_clearance_m)) {
    run.min_clearance_m = result.figures.min_clearance_m;
  }
  run.monitor_stops = result.figures.monitor_stops;
  run.evaluations = result.judging.evaluations + result.planning.evaluations;
  run.given_up = result.given_up;
  return run;
}

void hold_against_sequential(std::vector<PolicyRun>& runs) {
  const auto sequential = std::ranges::find(runs, "sequential", &PolicyRun::policy);
  if (sequential == runs.end() || !sequential->makespan) return;
  for (PolicyRun& run : runs) {
    if (!run.makespan) continue;
    run.makespan_ratio = to_seconds(*run.makespan) / to_seconds(*sequential->makespan);
  }
}

}  // namespace

Comparison::Comparison(CellPtr cell, std::function<void(std::function<void()>)> post)
    : cell_(std::move(cell)), post_(std::move(post)) {
  worker_.post(give_way);
}

Comparison::~Comparison() { cancel(); }

Result<ComparisonView> Comparison::start(Question question) {
  if (latest_ && latest_->state == ComparisonState::running) {
    return failure(Problem{ProblemKind::conflict, "comparison-under-way", "",
                           "another comparison is running: DELETE it, or wait for its end"});
  }
  const auto& jobs = question.taken.jobs;
  if (jobs.empty()) {
    return failure(
        Problem{ProblemKind::conflict, "no-jobs", "/since_s",
                "no job was submitted since then: give a smaller since_s, or leave it out; "
                "without it, none was submitted since the server started"});
  }
  ComparisonView view;
  view.jobs = jobs.size();
  view.first = jobs.front().submitted_at;
  view.last = jobs.back().submitted_at;
  view.in_force = question.in_force;
  view.policies = question.inquiry.policies;
  if (view.policies.empty()) view.policies = known_policies();
  latest_ = view;
  cancelled_ = std::make_shared<std::atomic<bool>>(false);
  worker_.post([this, question = std::make_shared<const Question>(std::move(question)),
                policies = view.policies,
                cancelled = cancelled_] { compare(*question, policies, cancelled); });
  return view;
}

void Comparison::cancel() {
  if (!latest_ || latest_->state != ComparisonState::running) return;
  cancelled_->store(true);
  latest_->state = ComparisonState::canceled;
}

// Drops updates of a comparison that has been canceled.
void Comparison::tell(const Cancelled& of, std::function<void(ComparisonView&)> change) {
  post_([this, of, change = std::move(change)] {
    if (!of->load()) change(*latest_);
  });
}

void Comparison::compare(const Question& question, const std::vector<std::string>& policies,
                         const Cancelled& cancelled) {
  const std::vector<TimedJob> jobs = timed_jobs(question.taken.jobs, *cell_);
  const CellPtr cell = cell_of(*cell_, question, jobs);
  const auto gives_up = [&](const Judging& judging, const Planning& planning) {
    return cancelled->load(std::memory_order_relaxed) ||
           judging.evaluations + planning.evaluations > kEvaluationsMax;
  };
  for (const std::string& policy : policies) {
    ExecutiveOptions options;
    options.policy = policy;
    options.seed = question.inquiry.seed;
    Nobody nobody;
    const auto result =
        simulate(cell, options, {jobs, time_limit(jobs, {}, *cell), {}, gives_up}, nobody);
    if (!result) {
      return tell(cancelled, [why = problem_sentence("", result.error().front())](auto& view) {
        view.state = ComparisonState::failed;
        view.detail = why;
      });
    }
    PolicyRun run = run_of(*result);
    run.policy = policy;
    tell(cancelled, [run](ComparisonView& view) {
      view.runs.push_back(run);
      hold_against_sequential(view.runs);
      if (view.runs.size() == view.policies.size()) view.state = ComparisonState::done;
    });
  }
}

}  // namespace armloom
