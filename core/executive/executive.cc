#include "core/executive/executive.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <limits>
#include <unordered_map>
#include <utility>

#include "core/arm/simulated_arm.h"
#include "core/collision/check_home.h"
#include "core/collision/collision_checker.h"
#include "core/executive/motions.h"
#include "core/executive/views.h"
#include "core/monitor/monitor.h"
#include "core/scheduler/scheduler.h"

namespace armloom {
namespace {

// Pairs of arms farther apart than this are not told in state frames nor counted as near.
constexpr double kClearanceHorizon_m = 2.0;

std::string sentence(const MonitorFinding& finding) {
  char text[256];
  std::snprintf(text, sizeof text, "monitor: %s and %s at %.4f m, limit %.4f m",
                finding.proximity.body_a.c_str(), finding.proximity.body_b.c_str(),
                finding.proximity.clearance_m, finding.limit_m);
  return text;
}

}  // namespace

class Executive::Impl final : public JobNames {
 public:
  Impl(CellPtr cell, ExecutiveOptions options, PlanningScenePtr scene,
       std::unique_ptr<const Policy> policy, std::vector<std::unique_ptr<ArmController>> arms,
       JudgePool& judges, Observer& observer);

  Result<JobView> submit(JobRequest request);
  Result<JobView> cancel(const std::string& key);
  void stop(std::vector<ArmId> arms, const std::string& cause);
  void resume(std::vector<ArmId> arms);
  std::optional<JobView> job(const std::string& key) const;
  Snapshot snapshot() const;
  void tick(TimePoint now);

  std::string key(JobId job) const override { return labels_.at(job).key; }
  std::string name(JobId job) const override { return labels_.at(job).name; }

  std::vector<ArmId> all_arms() const;

  CellPtr cell_;
  ExecutiveOptions options_;
  Scheduler scheduler_;
  RunFigures figures_;
  TimePoint now_{};

 private:
  struct Label {
    std::string key;
    std::string name;
  };

  void step(const Input& input);
  void carry_out(const Effect& effect);
  void watch();
  void tell_job(JobId job);
  void tell_arms();
  void tell_queue();
  template <class Body>
  void tell(Body body);
  void count(const JobView& ended);
  ArmState state_of(ArmId arm) const;
  ArmView view_of_arm(ArmId arm) const;
  QueueView queue() const;
  std::string free_key(JobId id) const;
  std::optional<Problems> starts_elsewhere(const Trajectory& trajectory) const;

  JudgePool& judges_;
  Observer& observer_;
  Motions motions_;
  Monitor monitor_;
  CollisionChecker checker_;
  Duration monitor_period_;
  TimePoint monitor_due_{};
  Configuration watched_;  // the configuration that the monitor looked at last
  std::vector<Proximity> clearance_;
  std::optional<TimePoint> wake_at_;

  std::unordered_map<std::string, JobId> ids_;
  std::unordered_map<JobId, Label> labels_;
  std::deque<JobId> ended_;  // oldest first
  std::uint64_t next_job_ = 1;
  std::uint64_t seq_ = 0;
  std::vector<ArmState> told_arms_;
  std::vector<std::string> told_arm_jobs_;
  QueueView told_queue_;
};

Executive::Impl::Impl(CellPtr cell, ExecutiveOptions options, PlanningScenePtr scene,
                      std::unique_ptr<const Policy> policy,
                      std::vector<std::unique_ptr<ArmController>> arms, JudgePool& judges,
                      Observer& observer)
    : cell_(cell),
      options_(std::move(options)),
      scheduler_(cell, std::move(policy), cell->home()),
      judges_(judges),
      observer_(observer),
      motions_(cell, std::move(arms), cell->home()),
      monitor_(cell->monitor),
      checker_(std::move(scene)),
      monitor_period_(from_seconds(1.0 / cell->monitor.rate_hz)),
      told_arms_(cell->arms.size(), ArmState::idle),
      told_arm_jobs_(cell->arms.size()),
      told_queue_(queue()) {
  figures_.busy.assign(cell_->arms.size(), Duration{});
  figures_.min_clearance_m = std::numeric_limits<double>::infinity();
}

// ---- What clients ask for ----

Result<JobView> Executive::Impl::submit(JobRequest request) {
  if (!request.key.empty() && ids_.contains(request.key)) {
    return failure(Problem{ProblemKind::conflict, "id-in-use", "/id",
                           "id \"" + request.key + "\" is in use by another job", request.key});
  }
  if (scheduler_.active().size() >= options_.waiting_max) {
    return failure(Problem{
        ProblemKind::unavailable, "queue-full", "",
        "the queue is full: " + std::to_string(options_.waiting_max) + " jobs have not ended"});
  }
  auto trajectory = validate(request.trajectory, *cell_);
  if (!trajectory) {
    Problems problems = std::move(trajectory.error());
    for (Problem& problem : problems) problem.pointer.insert(0, "/trajectory");
    return failure(std::move(problems));
  }
  if (auto elsewhere = starts_elsewhere(**trajectory)) return failure(std::move(*elsewhere));

  const JobId id{next_job_++};
  const std::string key = request.key.empty() ? free_key(id) : std::move(request.key);
  ids_.emplace(key, id);
  labels_.emplace(id, Label{key, std::move(request.name)});
  step(Submit{
      .job = id,
      .trajectory = std::move(*trajectory),
      .priority = request.priority,
      .backlog_timeout = request.backlog_timeout.value_or(cell_->scheduling.backlog_timeout)});
  return view_of(*scheduler_.find(id), *cell_, *this);
}

// "job-17"; where a client has taken that name, "job-17.2", ...
std::string Executive::Impl::free_key(JobId id) const {
  const std::string base = "job-" + std::to_string(id.value());
  std::string key = base;
  for (int n = 2; ids_.contains(key); ++n) key = base + "." + std::to_string(n);
  return key;
}

std::optional<Problems> Executive::Impl::starts_elsewhere(const Trajectory& trajectory) const {
  const Configuration rest = scheduler_.predicted_rest();
  Problems problems;
  for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
    const Joint& joint = cell_->joint(trajectory.joints()[j]);
    const double begins = trajectory.start()[static_cast<Eigen::Index>(j)];
    const double stands = rest[static_cast<Eigen::Index>(trajectory.joints()[j].index())];
    if (std::abs(begins - stands) <= cell_->execution.start_tolerance_rad) continue;
    char text[256];
    std::snprintf(text, sizeof text,
                  "waypoint 0, %s: begins at %.6g, but will stand at %.6g when the jobs accepted "
                  "for the arm have run",
                  joint.name.c_str(), begins, stands);
    problems.push_back(Problem{ProblemKind::invalid, "start-mismatch",
                               "/trajectory/points/0/positions/" + std::to_string(j), text,
                               begins});
  }
  if (problems.empty()) return std::nullopt;
  return problems;
}

Result<JobView> Executive::Impl::cancel(const std::string& key) {
  const auto it = ids_.find(key);
  if (it == ids_.end()) {
    return failure(Problem{ProblemKind::not_found, "unknown-job", "",
                           "no job has the id \"" + key + "\"", key});
  }
  const JobId id = it->second;
  const JobState state = scheduler_.find(id)->state;
  if (is_terminal(state)) {
    return failure(Problem{ProblemKind::conflict, "job-has-ended", "",
                           "job \"" + key + "\" has ended: " + to_string(state), key});
  }
  step(Cancel{id});
  return view_of(*scheduler_.find(id), *cell_, *this);
}

void Executive::Impl::stop(std::vector<ArmId> arms, const std::string& cause) {
  step(Stop{std::move(arms), cause});
}

void Executive::Impl::resume(std::vector<ArmId> arms) { step(Resume{std::move(arms)}); }

// ---- The scheduler and its effects ----

void Executive::Impl::step(const Input& input) {
  const std::vector<Effect> effects = scheduler_.step(input, now_);
  for (const Effect& effect : effects) carry_out(effect);
  if (std::holds_alternative<MotionReport>(input) && effects.empty()) return;
  tell_queue();
}

void Executive::Impl::carry_out(const Effect& effect) {
  if (const auto* judge = std::get_if<Judge>(&effect)) {
    judges_.ask(judge->question, [this](Verdict verdict) { step(Judged{std::move(verdict)}); });
  } else if (const auto* dispatch = std::get_if<Dispatch>(&effect)) {
    motions_.dispatch(*dispatch, scheduler_.find(dispatch->job)->trajectory);
  } else if (const auto* brake = std::get_if<Brake>(&effect)) {
    motions_.brake(brake->job);
  } else if (const auto* release = std::get_if<Release>(&effect)) {
    motions_.release(release->job);
  } else if (const auto* changed = std::get_if<JobChanged>(&effect)) {
    tell_job(changed->job);
  } else if (const auto* wake = std::get_if<WakeAt>(&effect)) {
    wake_at_ = wake->when;
  }
}

void Executive::Impl::tick(TimePoint now) {
  now_ = now;
  if (wake_at_ && now_ >= *wake_at_) {
    wake_at_.reset();
    step(Wake{});
  }
  for (const MotionReport& report : motions_.tick(now_)) step(report);
  for (ArmId arm : all_arms()) {
    if (motions_.moving(arm)) figures_.busy[arm.index()] += kControlPeriod;
  }
  if (now_ >= monitor_due_) {
    monitor_due_ = now_ + monitor_period_;
    watch();
  }
  tell_arms();
  observer_.on_tick(now_, motions_.measured());
}

// ---- The monitor ----

void Executive::Impl::watch() {
  const Configuration& q = motions_.measured();
  if (watched_.size() != q.size() || watched_ != q) {
    watched_ = q;
    clearance_ = checker_.closest_between_arms(q, kClearanceHorizon_m);
    for (const Proximity& pair : clearance_) {
      figures_.min_clearance_m = std::min(figures_.min_clearance_m, pair.clearance_m);
    }
    std::vector<bool> moving;
    for (ArmId arm : all_arms()) moving.push_back(motions_.moving(arm));
    const auto too_close = checker_.all_closer_than(q, cell_->monitor.stop_clearance_m);
    for (MonitorFinding& finding : monitor_.observe(too_close, moving, now_)) {
      MonitorEvent event{.finding = finding};
      for (const auto& arm : {finding.proximity.arm_a, finding.proximity.arm_b}) {
        if (arm && (event.arms.empty() || event.arms.front() != cell_->arm(*arm).name)) {
          event.arms.push_back(cell_->arm(*arm).name);
        }
      }
      for (ArmId arm : finding.stops) event.stopped.push_back(cell_->arm(arm).name);
      if (!finding.stops.empty()) ++figures_.monitor_stops;
      tell(event);
      if (!finding.stops.empty()) stop(finding.stops, sentence(finding));
    }
  }
  observer_.on_state(StateFrame{now_, q, clearance_});
}

// ---- What is told ----

template <class Body>
void Executive::Impl::tell(Body body) {
  observer_.on_event(Event{++seq_, now_, std::move(body)});
}

void Executive::Impl::tell_job(JobId job) {
  JobView view = view_of(*scheduler_.find(job), *cell_, *this);
  if (is_terminal(view.state)) count(view);
  tell(std::move(view));
}

void Executive::Impl::count(const JobView& ended) {
  figures_.last_end = std::max(figures_.last_end, *ended.ended_at);
  ended_.push_back(ended.id);
  while (ended_.size() > options_.ended_kept) {
    const JobId oldest = ended_.front();
    ended_.pop_front();
    ids_.erase(labels_.at(oldest).key);
    labels_.erase(oldest);
    scheduler_.forget(oldest);
  }
}

void Executive::Impl::tell_arms() {
  for (ArmId arm : all_arms()) {
    const ArmState state = state_of(arm);
    const auto occupant = scheduler_.occupant(arm);
    const std::string job = occupant ? key(*occupant) : std::string();
    if (state == told_arms_[arm.index()] && job == told_arm_jobs_[arm.index()]) continue;
    told_arms_[arm.index()] = state;
    told_arm_jobs_[arm.index()] = job;
    tell(view_of_arm(arm));
  }
}

void Executive::Impl::tell_queue() {
  QueueView now = queue();
  if (now == told_queue_) return;
  told_queue_ = now;
  tell(std::move(now));
}

QueueView Executive::Impl::queue() const {
  QueueView view{.policy = std::string(scheduler_.policy().name())};
  view.stopped = std::ranges::all_of(all_arms(), [&](ArmId a) { return scheduler_.stopped(a); });
  for (JobId id : scheduler_.active()) {
    switch (scheduler_.find(id)->state) {
      case JobState::queued:
        view.queued.push_back(key(id));
        break;
      case JobState::backlogged:
        view.backlog.push_back(key(id));
        break;
      case JobState::scheduled:
        view.scheduled.push_back(key(id));
        break;
      default:
        view.running.push_back(key(id));
        break;
    }
  }
  return view;
}

ArmState Executive::Impl::state_of(ArmId arm) const {
  using Phase = ArmFeedback::Phase;
  const Phase phase = motions_.feedback(arm).phase;
  if (phase == Phase::fault) return ArmState::fault;
  if (motions_.moving(arm)) return ArmState::moving;
  if (phase == Phase::stopped && scheduler_.occupant(arm)) return ArmState::holding;
  return scheduler_.stopped(arm) ? ArmState::stopped : ArmState::idle;
}

ArmView Executive::Impl::view_of_arm(ArmId id) const {
  const Arm& arm = cell_->arm(id);
  ArmView view{.name = arm.name,
               .robot = cell_->robots[arm.robot.index()].name,
               .state = state_of(id),
               .home = {arm.home.begin(), arm.home.end()},
               .deviation_rad = motions_.deviation(id)};
  if (const auto job = scheduler_.occupant(id)) {
    view.job = key(*job);
    const Job& j = *scheduler_.find(*job);
    view.progress = to_seconds(j.progress) / to_seconds(j.trajectory->duration());
  }
  for (JointId joint : arm.joints) {
    view.joints.push_back(cell_->joint(joint).name);
    view.q.push_back(motions_.measured()[static_cast<Eigen::Index>(joint.index())]);
  }
  return view;
}

std::vector<ArmId> Executive::Impl::all_arms() const {
  std::vector<ArmId> arms;
  for (std::size_t a = 0; a < cell_->arms.size(); ++a) {
    arms.emplace_back(static_cast<std::uint32_t>(a));
  }
  return arms;
}

std::optional<JobView> Executive::Impl::job(const std::string& key) const {
  const auto it = ids_.find(key);
  if (it == ids_.end()) return std::nullopt;
  return view_of(*scheduler_.find(it->second), *cell_, *this);
}

Snapshot Executive::Impl::snapshot() const {
  Snapshot snapshot{.seq = seq_, .time = now_, .queue = queue()};
  for (ArmId arm : all_arms()) snapshot.arms.push_back(view_of_arm(arm));
  for (JobId id : ended_) snapshot.jobs.push_back(view_of(*scheduler_.find(id), *cell_, *this));
  for (JobId id : scheduler_.active()) {
    snapshot.jobs.push_back(view_of(*scheduler_.find(id), *cell_, *this));
  }
  std::ranges::sort(snapshot.jobs, {}, &JobView::id);
  return snapshot;
}

// ---- The public face ----

Result<std::unique_ptr<Executive>> Executive::create(CellPtr cell, ExecutiveOptions options,
                                                     JudgePool& judges, Observer& observer) {
  auto policy =
      make_policy(options.policy.empty() ? cell->scheduling.policy : options.policy, *cell);
  if (!policy) return failure(std::move(policy.error()));
  auto scene = PlanningScene::build(cell);
  if (!scene) return failure(std::move(scene.error()));
  if (auto problems = check_home(*scene); !problems.empty()) return failure(std::move(problems));

  for (std::size_t r = 0; r < cell->robots.size(); ++r) {
    const std::string& type = cell->robots[r].controller.type;
    if (type == "sim") continue;
    return failure(Problem{ProblemKind::invalid, "unknown-controller",
                           "/robots/" + std::to_string(r) + "/controller/type",
                           "unknown controller type \"" + type + "\"; known is sim", type});
  }

  std::vector<std::unique_ptr<ArmController>> arms;
  const Configuration home = cell->home();
  for (std::size_t a = 0; a < cell->arms.size(); ++a) {
    const Arm& arm = cell->arms[a];
    std::vector<JointId> joints = arm.joints;
    joints.insert(joints.end(), arm.gripper_joints.begin(), arm.gripper_joints.end());
    Eigen::VectorXd q(static_cast<Eigen::Index>(joints.size()));
    for (std::size_t j = 0; j < joints.size(); ++j) {
      q[static_cast<Eigen::Index>(j)] = home[static_cast<Eigen::Index>(joints[j].index())];
    }
    arms.push_back(std::make_unique<SimulatedArm>(cell, ArmId{static_cast<std::uint32_t>(a)},
                                                  std::move(q), options.seed + a));
  }
  return std::unique_ptr<Executive>(
      new Executive(std::make_unique<Impl>(cell, std::move(options), std::move(*scene),
                                           std::move(*policy), std::move(arms), judges, observer)));
}

Executive::Executive(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Executive::~Executive() = default;

Result<JobView> Executive::submit(JobRequest request) { return impl_->submit(std::move(request)); }
Result<JobView> Executive::cancel(const std::string& key) { return impl_->cancel(key); }
void Executive::stop_all(const std::string& cause) { impl_->stop(impl_->all_arms(), cause); }
void Executive::resume_all() { impl_->resume(impl_->all_arms()); }
std::optional<JobView> Executive::job(const std::string& key) const { return impl_->job(key); }
Snapshot Executive::snapshot() const { return impl_->snapshot(); }
TimePoint Executive::now() const { return impl_->now_; }
bool Executive::all_ended() const { return impl_->scheduler_.active().empty(); }
const RunFigures& Executive::figures() const { return impl_->figures_; }
void Executive::tick(TimePoint now) { impl_->tick(now); }

}  // namespace armloom
