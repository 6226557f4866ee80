#include "test/faults/fault_run.h"

#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/model/cell/build_cell.h"
#include "test/faults/witness.h"
#include "test/scenarios/random_tasks.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

constexpr Duration kOperator = 100ms;    // between two looks of the operator
constexpr Duration kTidiesUp = 60s;      // after the last submission
constexpr Duration kReacts = 2s;         // of the operator
constexpr Duration kWaits = 5s;          // for an arm in which the fault can begin
constexpr Duration kRemovesAfter = 15s;  // a fault that stops no arm
constexpr Duration kPatience = 3600s;    // after the last job

// An arm that moves by itself while it does not report or does not stop.
bool cannot_be_stopped(const std::set<ArmFault::Kind>& kinds) {
  using Kind = ArmFault::Kind;
  const auto any_of = [&](std::initializer_list<Kind> some) {
    return std::ranges::any_of(some, [&](Kind kind) { return kinds.contains(kind); });
  };
  return any_of({Kind::drift, Kind::runaway}) &&
         any_of({Kind::ignore_stop, Kind::cut, Kind::drop_feedback, Kind::freeze_feedback});
}

std::string text_of_steps(const JobView& job) {
  std::string text;
  for (const StepView& step : job.steps) text += (text.empty() ? "; steps: " : ", ") + step.kind;
  if (job.step) text += "; at step " + std::to_string(*job.step + 1);
  return text;
}

// One run.
class FaultRun {
 public:
  explicit FaultRun(const FaultRunPlan& plan) : plan_(plan), random_(plan.seed) {
    CellDescription description = random_cell(plan.world, random_);
    for (RobotDescription& robot : description.robots) {
      if (plan.faulty) break;
      robot.controller.noise_rad = 0.1 * description.checking.tracking_error_rad;
      robot.controller.lag = from_seconds(random_.uniform(0.0, 0.05));
    }
    if (plan.tasks) RandomTasks::equip(description);
    auto cell = build_cell(description);
    if (!cell) throw std::runtime_error(cell.error().front().detail);
    cell_ = *cell;
    witness_ = std::make_unique<Witness>(cell_, plan.verbose);
    auto created = Simulation::create(
        cell_,
        ExecutiveOptions{.policy = plan.policy, .seed = plan.seed, .monitored = plan.monitored},
        *witness_);
    if (!created) throw std::runtime_error(created.error().front().detail);
    simulation_ = std::move(*created);
    jobs_ = std::make_unique<RandomJobs>(
        *cell_, random_, [this]() -> Executive& { return executive(); }, !plan.faulty);
    simulation_->tick();
    if (plan.tasks) {
      tasks_.emplace(*cell_, random_, *jobs_, [this]() -> Executive& { return executive(); });
      witness_->watch(*tasks_, executive());
      tasks_->place_parts();
    }
    begins_at_ = at(from_seconds(random_.uniform(1.0, 0.5 * to_seconds(plan.jobs_for))));
  }

  [[nodiscard]] Executive& executive() { return simulation_->executive(); }
  [[nodiscard]] Witness& witness() { return *witness_; }
  [[nodiscard]] const CellPtr& cell() const { return cell_; }
  [[nodiscard]] TimePoint now() const { return simulation_->now(); }

  void run_until(TimePoint end) {
    while (now() < end && !is_done()) {
      const TimePoint until = std::min(now() + kOperator, end);
      if (now() < at(plan_.jobs_for) && now() >= next_job_) submit();
      // Jobs may wait for a part that two hands hold.
      if (now() >= at(plan_.jobs_for) && now() >= next_job_ && tasks_) {
        next_job_ = now() + kTidiesUp;
        tidy_up();
      }
      if (plan_.faulty && now() >= begins_at_) begin_fault();
      operate();
      while (now() < until) {
        simulation_->pass_over_rest(until);
        simulation_->tick();
      }
    }
  }

  FaultRunResult result() {
    witness_->audit_states();
    FaultRunResult result{.jobs = submitted_,
                          .lost = {witness_->lost.begin(), witness_->lost.end()},
                          .contact = witness_->contact,
                          .may_touch = touches_may_occur(),
                          .closest_m = witness_->closest_m,
                          .guard_refusals = witness_->refusals,
                          .stops = witness_->stops,
                          .stops_of_faulty = witness_->stops_of_faulty,
                          .simulated = now().time_since_epoch(),
                          .fingerprint = witness_->fingerprint};
    for (const JobView& job : executive().snapshot().jobs) {
      if (job.state == JobState::succeeded) ++result.succeeded;
      if (is_terminal(job.state)) continue;
      if (job.waits_on.empty() && !moves(job)) {
        result.silent.push_back(told(job) + text_of_steps(job));
      } else {
        ++result.waiting;
        if (plan_.verbose) {
          std::fprintf(stderr, "waiting: %s%s\n", told(job).c_str(), text_of_steps(job).c_str());
        }
      }
    }
    return result;
  }

 private:
  // Returns true if a fault that may touch was present at the contact.
  [[nodiscard]] bool touches_may_occur() const {
    return std::ranges::any_of(touching_, [this](const auto& period) {
      const auto& contact = witness_->contact;
      return contact && period.first <= contact->time && contact->time <= period.second;
    });
  }
  [[nodiscard]] bool moves(const JobView& job) {
    return std::ranges::any_of(executive().arms(), [&](const ArmView& arm) {
      return arm.job == job.key && arm.state == ArmState::moving;
    });
  }
  [[nodiscard]] bool is_done() {
    if (now() < at(plan_.jobs_for)) return false;
    return now() >= at(plan_.jobs_for + kPatience) ||
           ((begins_at_ == TimePoint::max() || !plan_.faulty) && present_.empty() &&
            executive().all_ended());
  }

  // With a fault, the server may not know where an arm is; an operator sees it, and keeps away.
  void tidy_up() {
    if (tasks_ && present_.empty()) tasks_->tidy_up();
  }

  void submit() {
    next_job_ = now() + from_seconds(random_.uniform(0.1, 1.6));
    if (witness_->open.size() >= plan_.open_max) {
      tidy_up();  // jobs may wait for an object that two hands hold
      return;
    }
    std::optional<JobRequest> task;
    if (tasks_) tasks_->set_input();
    if (tasks_ && random_.chance(0.2)) tidy_up();
    if (tasks_ && random_.chance(0.6)) task = tasks_->any();
    JobRequest request = task ? *std::move(task) : jobs_->any();
    const JobRequest copy = request;
    const auto accepted = executive().submit(std::move(request));
    if (!accepted) return;
    ++submitted_;
    jobs_->accepted(accepted->key, copy);
  }

  // Returns the names of the arms in a state.
  [[nodiscard]] std::vector<std::string> arms_in(ArmState state) {
    std::vector<std::string> names;
    for (const ArmView& arm : executive().arms()) {
      if (arm.state == state) names.push_back(arm.name);
    }
    return names;
  }

  // Begins the fault where it has the largest effect: `runaway` in an arm that waits at its
  // authority, others in a moving arm. If there is none for kWaits, in any arm.
  void begin_fault() {
    const auto& list = listed_faults();
    if (next_fault_ == nullptr) {
      next_fault_ = plan_.fault != nullptr ? plan_.fault : &list[random_.index(list.size())];
    }
    const ListedFault& fault = *next_fault_;
    const bool runs_away = fault.faults.front().kind == ArmFault::Kind::runaway;
    std::vector<std::string> arms = arms_in(runs_away ? ArmState::paused : ArmState::moving);
    if (arms.empty() && now() < begins_at_ + kWaits) return;
    if (arms.empty()) arms = arms_in(ArmState::moving);
    if (arms.empty()) arms.push_back(jobs_->arms().front().name);
    const std::string arm = arms[random_.index(arms.size())];
    next_fault_ = nullptr;
    for (const FaultRequest& request : fault.faults) kinds_[arm].insert(request.kind);
    const ArmView view = executive().arms()[cell_->find_arm(arm)->index()];
    if (view.link != ArmLink::State::up) kinds_[arm].insert(ArmFault::Kind::cut);  // after a fault
    if (fault.may_touch || cannot_be_stopped(kinds_[arm])) {
      touching_.emplace_back(now(), TimePoint::max());
    }
    witness_->faulty.insert(arm);
    if (plan_.verbose) {
      std::fprintf(stderr, "%9.3f s  fault in %s: %s\n", to_seconds(now().time_since_epoch()),
                   arm.c_str(), fault.name.c_str());
    }
    for (FaultRequest request : fault.faults) {
      request.arm = arm;
      const auto id = executive().faults().inject(request);
      if (!id) throw std::runtime_error(id.error().front().detail);
      present_.push_back(*id);
    }
    removes_at_ = now() + kRemovesAfter;
    begins_at_ = now() + from_seconds(random_.uniform(5.0, 40.0));
    if (plan_.fault != nullptr || begins_at_ > at(plan_.jobs_for)) begins_at_ = TimePoint::max();
  }

  // Resumes stopped arms, and removes the faults then.
  void operate() {
    const std::vector<ArmView> arms = executive().arms();
    const bool any_stopped = std::ranges::any_of(arms, [](const ArmView& arm) {
      return arm.state == ArmState::stopped || arm.state == ArmState::fault;
    });
    if (!any_stopped) stopped_since_.reset();
    if (any_stopped && !stopped_since_) stopped_since_ = now();
    const bool acts = stopped_since_ && now() - *stopped_since_ >= kReacts;
    if (acts || now() >= removes_at_) {
      if (plan_.verbose && !present_.empty()) {
        std::fprintf(stderr, "%9.3f s  faults end\n", to_seconds(now().time_since_epoch()));
      }
      for (const std::uint64_t id : std::exchange(present_, {})) {
        (void)executive().faults().remove(id);
      }
      for (auto& [begin, end] : touching_) end = std::min(end, now());
      kinds_.clear();
      removes_at_ = TimePoint::max();
    }
    if (!acts) return;
    stopped_since_ = now();
    resume_all(executive());
  }

  FaultRunPlan plan_;
  Random random_;
  CellPtr cell_;
  std::unique_ptr<Witness> witness_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<RandomJobs> jobs_;
  std::optional<RandomTasks> tasks_;
  TimePoint next_job_{}, begins_at_{}, removes_at_ = TimePoint::max();
  std::optional<TimePoint> stopped_since_;
  std::vector<std::uint64_t> present_;                     // faults
  std::map<std::string, std::set<ArmFault::Kind>> kinds_;  // of present faults, by arm
  std::vector<std::pair<TimePoint, TimePoint>>
      touching_;  // when faults that may touch were present
  const ListedFault* next_fault_ = nullptr;
  std::size_t submitted_ = 0;
};

}  // namespace

FaultRunResult run_with_faults(const FaultRunPlan& plan) {
  FaultRun run(plan);
  run.run_until(TimePoint::max());
  return run.result();
}

double distance_without_monitor(FaultRunPlan plan, const FaultRunResult::MonitorStop& stop) {
  plan.monitored = plan.verbose = false;
  FaultRun run(plan);
  auto scene = PlanningScene::build(run.cell());
  if (!scene) throw std::runtime_error(scene.error().front().detail);
  run.witness().watch({stop.arm, stop.time, ClearanceQuery(*scene)});
  run.run_until(stop.time + kEndangeredFor);
  return run.witness().watched_m;
}

}  // namespace armloom
