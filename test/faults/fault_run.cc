#include "test/faults/fault_run.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/collision/state/clearance_query.h"
#include "core/model/cell/build_cell.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

constexpr Duration kSample = 5ms;           // between audited states
constexpr Duration kOperator = 100ms;       // between two looks of the operator
constexpr Duration kReacts = 2s;            // of the operator
constexpr Duration kWaits = 5s;             // for an arm in which the fault can begin
constexpr Duration kRemovesAfter = 15s;     // a fault that stops no arm
constexpr Duration kPatience = 3600s;        // after the last job
constexpr std::size_t kStatesMax = 20'000;  // that are audited at once

// Collects what an audit needs, and what the monitor does.
class Witness final : public Observer {
 public:
  Witness(CellPtr cell, bool verbose) : cell_(std::move(cell)), verbose_(verbose) {}

  void on_event(const Event& event) override {
    mix(event.seq);
    mix(static_cast<std::uint64_t>(event.time.time_since_epoch().count()));
    mix(event.body.index());
    if (verbose_) print(event);
    if (const auto* job = std::get_if<JobView>(&event.body)) {
      if (is_terminal(job->state)) {
        open.erase(job->key);
      } else {
        open.insert(job->key);
      }
    }
    if (const auto* arm = std::get_if<ArmView>(&event.body)) jobs_[arm->name] = arm->job;
    if (std::holds_alternative<GuardEvent>(event.body)) ++refusals;
    if (const auto* found = std::get_if<MonitorEvent>(&event.body)) see(event.time, *found);
  }
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}

  void on_truth(TimePoint now, const Configuration& q) override {
    if (now < next_) return;
    next_ = now + kSample;
    for (const double position : q) mix(std::bit_cast<std::uint64_t>(position));
    if (watch_ && now >= watch_->from) look(q);
    if (!states_.empty() && states_.back().q == q) {
      rests_until_ = now;
      return;
    }
    if (rests_until_ && *rests_until_ > states_.back().time) {
      states_.push_back({*rests_until_, states_.back().q, true});
    }
    rests_until_.reset();
    states_.push_back({now, q});
    if (states_.size() >= kStatesMax) audit_states();
  }

  void audit_states() {
    if (states_.empty()) return;
    const auto report = audit(*cell_, states_, kSample);
    if (!report) throw std::runtime_error(report.error().front().detail);
    if (!contact) contact = report->first_contact;
    if (report->smallest_clearance) {
      closest_m = std::min(closest_m, report->smallest_clearance->distance_m);
    }
    states_.erase(states_.begin(), std::prev(states_.end()));
  }

  // From now on, measures the distances of one arm.
  struct Watched {
    ArmId arm;
    TimePoint from;
    ClearanceQuery query;
  };
  void watch(Watched watched) { watch_.emplace(std::move(watched)); }

  std::set<std::string> faulty;  // names
  std::set<std::string> open;    // keys of jobs that have not ended
  std::vector<FaultRunResult::MonitorStop> stops;
  std::size_t stops_of_faulty = 0;
  std::uint64_t refusals = 0, fingerprint = 14695981039346656037U;
  std::optional<AuditFinding> contact;
  double closest_m = 1e9;
  double watched_m = 2.0;

 private:
  void mix(std::uint64_t word) { fingerprint = (fingerprint ^ word) * 1099511628211U; }

  static void print(const Event& event) {
    std::string text;
    if (const auto* alert = std::get_if<Alert>(&event.body)) text = alert->text;
    if (const auto* job = std::get_if<JobView>(&event.body)) text = told(*job);
    if (!text.empty()) std::fprintf(stderr, "%9.3f s  %s\n", to_seconds(event.time), text.c_str());
  }

  void see(TimePoint time, const MonitorEvent& event) {
    const auto is_excused = [&](const std::string& arm) {
      return std::ranges::any_of(faulty, [&](const std::string& other) {
        return other == arm || (!jobs_[arm].empty() && jobs_[arm] == jobs_[other]);
      });
    };
    for (const std::string& arm : event.stopped) {
      if (is_excused(arm)) {
        ++stops_of_faulty;
      } else {
        stops.push_back({time, *cell_->find_arm(arm), arm});
      }
    }
  }

  void look(const Configuration& q) {
    for (const Proximity& pair : watch_->query.closest_apart(q, watched_m).apart) {
      if (pair.arm_a == watch_->arm || pair.arm_b == watch_->arm) {
        watched_m = std::min(watched_m, pair.clearance_m);
      }
    }
  }

  CellPtr cell_;
  bool verbose_;
  std::map<std::string, std::string> jobs_;  // by arm
  std::vector<RecordedState> states_;
  std::optional<TimePoint> rests_until_;
  TimePoint next_{};
  std::optional<Watched> watch_;
};

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
        result.silent.push_back(told(job));
      } else {
        ++result.waiting;
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
           (begins_at_ == TimePoint::max() && present_.empty() && executive().all_ended());
  }

  void submit() {
    next_job_ = now() + from_seconds(random_.uniform(0.1, 1.6));
    if (witness_->open.size() >= plan_.open_max) return;
    JobRequest request = jobs_->any();
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
    if (fault.may_touch) touching_.emplace_back(now(), TimePoint::max());
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
  TimePoint next_job_{}, begins_at_{}, removes_at_ = TimePoint::max();
  std::optional<TimePoint> stopped_since_;
  std::vector<std::uint64_t> present_;  // faults
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
