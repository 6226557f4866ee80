#include "core/executive/executive_impl.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/executive/arms_of.h"

namespace armloom {
namespace {

std::vector<std::unique_ptr<ArmController>> controllers(
    std::vector<std::unique_ptr<FaultyArm>> arms) {
  return {std::make_move_iterator(arms.begin()), std::make_move_iterator(arms.end())};
}

// Those of the pair, and those that stop.
MonitorEvent event_of(const MonitorFinding& finding, const Cell& cell) {
  MonitorEvent event{.finding = finding};
  for (const auto& arm : {finding.proximity.arm_a, finding.proximity.arm_b}) {
    if (arm && (event.arms.empty() || event.arms.front() != cell.arm(*arm).name)) {
      event.arms.push_back(cell.arm(*arm).name);
    }
  }
  for (ArmId arm : finding.stops) event.stopped.push_back(cell.arm(arm).name);
  return event;
}

}  // namespace

Executive::Impl::Impl(Checked checked, ExecutiveOptions options, JudgementService& judges,
                      Observer& observer)
    : cell_(checked.cell),
      options_(std::move(options)),
      scheduler_(cell_, std::move(checked.policy), cell_->home()),
      scene_{std::move(checked.scene)},
      faults_(cell_, checked.arms),
      drawings_(scheduler_, jobs_, judges),
      publisher_({*cell_, scheduler_, motions_, jobs_, starts_}, observer),
      judges_(judges),
      intake_(cell_, scheduler_, jobs_, options_.waiting_max),
      plans_(judges),
      motions_(cell_, controllers(std::move(checked.arms)), cell_->home()),
      starts_(options_.starts),
      watch_(scene_.scene) {
  figures_.busy.assign(cell_->arms.size(), Duration{});
  figures_.min_clearance_m = figures_.between_arms_m = std::numeric_limits<double>::infinity();
}

void Executive::Impl::note(ExecutiveInput input) const {
  if (options_.inputs != nullptr) options_.inputs->came(ticks_, input);
}

// ---- The scheduler and its effects ----

void Executive::Impl::step(const Input& input) {
  const std::vector<Effect> effects = decided(input);
  for (const Effect& effect : effects) carry_out(effect);
  if (std::holds_alternative<MotionReport>(input) && effects.empty()) return;
  publisher_.tell_stops();
  publisher_.queue_may_have_changed(now_);
}

// What a scheduler says whose invariant is broken is not to be relied on: the arms come to rest on
// their paths, and the process ends.
std::vector<Effect> Executive::Impl::decided(const Input& input) {
  try {
    return scheduler_.step(input, now_);
  } catch (const std::logic_error&) {
    motions_.brake_all();
    throw;
  }
}

void Executive::Impl::carry_out(const Effect& effect) {
  if (const auto* judge = std::get_if<Judge>(&effect)) {
    this->judge(judge->question);
  } else if (const auto* plan = std::get_if<PlanMotion>(&effect)) {
    plans_.ask(*plan, scene_.scene, [this](PlanMade made) {
      note({ExecutiveInput::Planned{made.job, made.question}});
      step(made);
    });
  } else if (const auto* dispatch = std::get_if<Dispatch>(&effect)) {
    this->dispatch(*dispatch);
  } else if (const auto* grant = std::get_if<Grant>(&effect)) {
    this->grant(*grant);
  } else if (const auto* aside = std::get_if<YieldMove>(&effect)) {
    note_aside(*aside);
  } else if (const auto* brake = std::get_if<Brake>(&effect)) {
    motions_.brake(brake->job);
  } else if (const auto* release = std::get_if<Release>(&effect)) {
    motions_.release(release->job);
  } else if (const auto* changed = std::get_if<JobChanged>(&effect)) {
    job_changed(changed->job);
  } else if (const auto* wake = std::get_if<WakeAt>(&effect)) {
    wake_at_ = wake->when;
  }
}

void Executive::Impl::judge(const Question& question) {
  asked_ = question;
  judges_.ask(question, scene_.scene, [this](Verdict verdict) {
    note({ExecutiveInput::Judged{verdict.evaluations}});
    asked_.reset();
    step(Judged{std::move(verdict)});
  });
}

void Executive::Impl::dispatch(const Dispatch& dispatch) {
  const Job& job = *scheduler_.find(dispatch.job);
  if (job.system_job) return motions_.dispatch(dispatch, job.trajectory);
  const auto written = [this, id = job.id] { start_is_written(id); };
  motions_.dispatch(starts_.pass(dispatch, written), job.trajectory);
}

void Executive::Impl::grant(const Grant& grant) {
  if (!starts_.keeps(grant)) motions_.grant(grant);
}

void Executive::Impl::start_is_written(JobId job) {
  note({ExecutiveInput::StartWritten{job}});
  const auto withheld = starts_.open(job);
  if (withheld && scheduler_.find(job)->in<Moving>() != nullptr) motions_.grant({job, *withheld});
}

void Executive::Impl::note_aside(const YieldMove& aside) {
  const std::string arm = cell_->arm(aside.arm).name;
  const std::string blocked = jobs_.key(aside.blocked_job);
  const OwnJob kind = aside.to_start ? OwnJob::approach : OwnJob::aside;
  const std::string name = aside.to_start  ? arm + " goes to the start of " + blocked
                           : aside.returns ? arm + " returns to where it stood"
                                           : arm + " moves aside for " + blocked;
  jobs_.add(aside.job, {jobs_.own_key(kind), name});
  if (aside.to_start) {
    intake_.forget_way_back(aside.arm);
  } else if (!aside.in_ring) {
    intake_.remember_way_back(aside.arm, *scheduler_.find(aside.job)->trajectory);
  }
}

void Executive::Impl::job_changed(JobId id) {
  JobView view = publisher_.view(id);
  if (is_terminal(view.state)) {
    figures_.last_end = std::max(figures_.last_end, *view.ended_at);
    plans_.give_up(id);
    starts_.forget(id);
    for (JobId oldest : jobs_.end(id, options_.ended_kept)) scheduler_.forget(oldest);
  }
  publisher_.tell_job(std::move(view), now_);
}

// ---- Time ----

void Executive::Impl::tick(TimePoint now) {
  now_ = now;
  ++ticks_;
  if (options_.dies_at && now_ >= *options_.dies_at) {
    motions_.tick_arms(now_);
    publisher_.tell_tick(now_);
    return;
  }
  quiet_ = motions_.all_settled();
  if (wake_at_ && now_ >= *wake_at_) {
    wake_at_.reset();
    quiet_ = false;
    step(Wake{});
  }
  for (const MotionReport& report : motions_.tick(now_)) {
    quiet_ = false;
    const bool may_move =
        report.kind != MotionReport::Kind::progressed || !starts_.withholds(report.job);
    if (may_move) step(report);
  }
  count_motion();
  if (watch_.is_due(now_)) watch();
  publisher_.tell_queue(now_);
  publisher_.tell_arms(now_);
  publisher_.tell_tick(now_);
  const auto is_moving = [this](ArmId arm) { return motions_.moving(arm); };
  if (wind_down_ && wind_down_->done && std::ranges::none_of(all_arms(*cell_), is_moving)) {
    step(Interrupt{wind_down_->keeps_waiting});
    std::exchange(wind_down_->done, nullptr)();
  }
}

TimePoint Executive::Impl::settled_until() const {
  return quiet_ && motions_.all_settled() && !publisher_.is_behind()
             ? wake_at_.value_or(TimePoint::max())
             : now_;
}

void Executive::Impl::count_motion() {
  std::size_t in_motion = 0;
  for (ArmId arm : all_arms(*cell_)) {
    if (!motions_.advances(arm)) continue;
    figures_.busy[arm.index()] += kControlPeriod;
    ++in_motion;
  }
  if (in_motion >= 2) figures_.together += kControlPeriod;
}

void Executive::Impl::watch() {
  const Configuration& q = motions_.measured();
  std::vector<bool> moving;
  for (ArmId arm : all_arms(*cell_)) moving.push_back(motions_.moving(arm));
  if (watch_.look(q, moving, now_)) {
    for (const Proximity& pair : watch_.near()) {
      figures_.min_clearance_m = std::min(figures_.min_clearance_m, pair.clearance_m);
      if (!pair.arm_b) continue;
      figures_.between_arms_m = std::min(figures_.between_arms_m, pair.clearance_m);
    }
    for (const MonitorFinding& finding : watch_.found()) {
      if (!finding.stops.empty()) ++figures_.monitor_stops;
      publisher_.tell(event_of(finding, *cell_), now_);
      if (!finding.stops.empty()) step(Stop{finding.stops, sentence(finding)});
    }
  }
  publisher_.tell_state(watch_.near(), now_);
}

// ---- What is asked of all arms ----

void Executive::Impl::stop(const std::vector<ArmId>& arms, const std::string& cause) {
  publisher_.tell(
      Alert{Alert::Level::warning, "stopped: " + names_of(*cell_, arms) + " (" + cause + ")"},
      now_);
  step(Stop{arms, cause});
}

void Executive::Impl::resume(const std::vector<ArmId>& arms) {
  publisher_.tell(Alert{Alert::Level::info, "resumed: " + names_of(*cell_, arms)}, now_);
  step(Resume{arms});
}

void Executive::Impl::end(const std::string& cause, bool keeps_waiting,
                          std::function<void()> done) {
  wind_down_ = {std::move(done), keeps_waiting};
  intake_.close();
  stop(all_arms(*cell_), cause);
}

// An object may not be set where an arm stands: that is a mistake, or an accident that the monitor
// would answer with a stop.
Result<void> Executive::Impl::change_objects(Result<std::vector<CollisionObject>> objects) {
  if (!objects) return failure(std::move(objects.error()));
  auto scene = scene_.scene->with_objects(*std::move(objects));
  if (!scene) return failure(std::move(scene.error()));
  ClearanceQuery query = StateWatch::query_of(*scene);
  for (const NearPair& closer : query.near_pairs(motions_.measured())) {
    const Proximity pair = query.describe(closer);
    if (!pair.object_b) continue;
    char text[256];
    std::snprintf(text, sizeof text, "%s would be %.4f m from %s as it stands now, limit %.4f m",
                  pair.body_b.c_str(), pair.clearance_m, pair.body_a.c_str(), pair.limit_m);
    return failure(Problem{ProblemKind::conflict, "object-in-arm", "", text, pair.clearance_m});
  }
  scene_ = {std::move(*scene), scene_.version + 1};
  watch_.follow(std::move(query));
  publisher_.tell(SceneView{scene_.version, scene_.scene->objects()}, now_);
  step(SceneChanged{});
  return {};
}

// ---- What is to be seen ----

std::optional<JobView> Executive::Impl::job(const std::string& key) const {
  const auto id = jobs_.find(key);
  return id ? std::optional(publisher_.view(*id)) : std::nullopt;
}

Snapshot Executive::Impl::snapshot(std::size_t ended_max) const {
  Snapshot snapshot{.seq = publisher_.seq(),
                    .time = now_,
                    .queue = publisher_.queue(),
                    .arms = publisher_.arms()};
  snapshot.scene = SceneView{scene_.version, scene_.scene->objects()};
  const auto& ended = jobs_.ended();
  for (std::size_t i = ended.size() - std::min(ended_max, ended.size()); i < ended.size(); ++i) {
    snapshot.jobs.push_back(publisher_.view(ended[i]));
  }
  for (JobId id : scheduler_.active()) snapshot.jobs.push_back(publisher_.view(id));
  std::ranges::sort(snapshot.jobs, {}, &JobView::id);
  return snapshot;
}

}  // namespace armloom
