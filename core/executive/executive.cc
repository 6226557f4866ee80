#include "core/executive/executive.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/executive/executive_impl.h"
#include "core/executive/timeline.h"

namespace armloom {
namespace {

// What is farther apart than this is not told in state frames nor counted as near.
constexpr double kClearanceHorizon_m = 2.0;

std::string sentence(const MonitorFinding& finding) {
  char text[256];
  std::snprintf(text, sizeof text, "monitor: %s and %s at %.4f m, limit %.4f m",
                finding.proximity.body_a.c_str(), finding.proximity.body_b.c_str(),
                finding.proximity.clearance_m, finding.limit_m);
  return text;
}

std::vector<FaultyArm*> pointers(const std::vector<std::unique_ptr<FaultyArm>>& arms) {
  std::vector<FaultyArm*> result;
  for (const auto& arm : arms) result.push_back(arm.get());
  return result;
}

std::vector<std::unique_ptr<ArmController>> controllers(
    std::vector<std::unique_ptr<FaultyArm>> arms) {
  return {std::make_move_iterator(arms.begin()), std::make_move_iterator(arms.end())};
}

}  // namespace

ClearanceQuery Executive::Impl::monitored(const PlanningScenePtr& scene) {
  const Cell& cell = scene->cell();
  return ClearanceQuery(scene, PairLimits::scaled(cell, cell.monitor.stop_clearance_m));
}

Executive::Impl::Impl(Checked checked, ExecutiveOptions options, JudgementService& judges,
                      Observer& observer)
    : cell_(checked.cell),
      options_(std::move(options)),
      scheduler_(cell_, std::move(checked.policy), cell_->home()),
      scene_(std::move(checked.scene)),
      judges_(judges),
      observer_(observer),
      faulty_(pointers(checked.arms)),
      motions_(cell_, controllers(std::move(checked.arms)), cell_->home()),
      clearance_query_(monitored(scene_)),
      monitor_period_(from_seconds(1.0 / cell_->monitor.rate_hz)),
      told_arms_(cell_->arms.size(), ArmState::idle),
      told_arm_jobs_(cell_->arms.size()),
      told_queue_(queue()) {
  figures_.busy.assign(cell_->arms.size(), Duration{});
  figures_.min_clearance_m = figures_.between_arms_m = std::numeric_limits<double>::infinity();
}

// ---- The scheduler and its effects ----

void Executive::Impl::step(const Input& input) {
  const std::vector<Effect> effects = decided(input);
  for (const Effect& effect : effects) carry_out(effect);
  if (std::holds_alternative<MotionReport>(input) && effects.empty()) return;
  tell_stops();
  tell_queue();
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
    asked_ = judge->question;
    judges_.ask(judge->question, scene_, [this](Verdict verdict) {
      asked_.reset();
      step(Judged{std::move(verdict)});
    });
  } else if (const auto* plan = std::get_if<PlanMotion>(&effect)) {
    ask_plan(*plan);
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
    tell_job(changed->job);
  } else if (const auto* wake = std::get_if<WakeAt>(&effect)) {
    wake_at_ = wake->when;
  }
}

void Executive::Impl::tick(TimePoint now) {
  now_ = now;
  if (options_.dies_at && now_ >= *options_.dies_at) {
    motions_.tick_arms(now_);
    tell_tick();
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
    const bool may_move = report.kind != MotionReport::Kind::progressed || !is_withheld(report.job);
    if (may_move) step(report);
  }
  std::size_t in_motion = 0;
  for (ArmId arm : all_arms()) {
    if (!motions_.advances(arm)) continue;
    figures_.busy[arm.index()] += kControlPeriod;
    ++in_motion;
  }
  if (in_motion >= 2) figures_.together += kControlPeriod;
  if (now_ >= monitor_due_) {
    monitor_due_ = now_ + monitor_period_;
    watch();
  }
  tell_arms();
  tell_tick();
  if (wound_down_ && !any_moving()) {
    step(Interrupt{keeps_waiting_});
    std::exchange(wound_down_, nullptr)();
  }
}

void Executive::Impl::tell_tick() {
  if (const bool at_rest = motions_.all_at_rest(); at_rest != told_rest_) {
    told_rest_ = at_rest;
    observer_.on_rest(at_rest);
  }
  observer_.on_tick(now_, motions_.measured());
}

// ---- The monitor ----

void Executive::Impl::watch() {
  const Configuration& q = motions_.measured();
  if (watched_.size() != q.size() || watched_ != q) {
    watched_ = q;
    clearance_ = clearance_query_.closest_apart(q, kClearanceHorizon_m);
    for (const Proximity& pair : clearance_) {
      figures_.min_clearance_m = std::min(figures_.min_clearance_m, pair.clearance_m);
      if (!pair.arm_b) continue;
      figures_.between_arms_m = std::min(figures_.between_arms_m, pair.clearance_m);
    }
    std::vector<bool> moving;
    for (ArmId arm : all_arms()) moving.push_back(motions_.moving(arm));
    const Configuration* state[] = {&q};
    std::vector<Proximity> too_close;
    if (clearance_query_.too_close(state) != 0) too_close = clearance_query_.closest_too_close(q);
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
      if (!finding.stops.empty()) step(Stop{finding.stops, sentence(finding)});
    }
  }
  observer_.on_state(StateFrame{now_, q, clearance_});
}

// ---- The public face ----

Executive::Executive(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Executive::~Executive() = default;

Result<JobView> Executive::submit(JobRequest request) { return impl_->submit(std::move(request)); }
Result<std::vector<Result<JobView>>> Executive::submit_batch(std::vector<JobRequest> requests,
                                                             bool atomic) {
  return impl_->submit_batch(std::move(requests), atomic);
}
void Executive::check(JobRequest request, std::function<void(Result<CheckView>)> done) {
  impl_->check(std::move(request), std::move(done));
}
void Executive::plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
                     std::function<void(Result<PlanOutcome>)> done) {
  impl_->plan(std::move(inquiry), std::move(cancelled), std::move(done));
}
void Executive::diagram(const std::string& key_a, const std::string& key_b,
                        std::function<void(Result<DiagramView>)> done) {
  impl_->diagram(key_a, key_b, std::move(done));
}
Result<JobView> Executive::cancel(const std::string& key) { return impl_->cancel(key); }
void Executive::stop(const std::vector<ArmId>& arms, const std::string& cause) {
  impl_->tell(
      Alert{Alert::Level::warning, "stopped: " + impl_->names_of(arms) + " (" + cause + ")"});
  impl_->step(Stop{arms, cause});
}
void Executive::resume(const std::vector<ArmId>& arms) {
  impl_->tell(Alert{Alert::Level::info, "resumed: " + impl_->names_of(arms)});
  impl_->step(Resume{arms});
}
void Executive::wind_down(const std::string& cause, Waiting waiting, std::function<void()> done) {
  impl_->wound_down_ = std::move(done);
  impl_->keeps_waiting_ = waiting == Waiting::is_kept;
  stop_all(cause);
}
std::vector<Result<JobView>> Executive::restore(std::vector<RestoredJob> jobs) {
  return impl_->restore(std::move(jobs));
}
void Executive::stop_all(const std::string& cause) { stop(impl_->all_arms(), cause); }
void Executive::resume_all() { resume(impl_->all_arms()); }
Result<void> Executive::add_object(CollisionObject object) {
  return impl_->add_object(std::move(object));
}
Result<void> Executive::replace_object(CollisionObject object) {
  return impl_->replace_object(std::move(object));
}
Result<void> Executive::remove_object(const std::string& name) {
  return impl_->remove_object(name);
}
const std::vector<CollisionObject>& Executive::objects() const { return impl_->scene_->objects(); }
std::uint64_t Executive::scene_version() const { return impl_->scene_version_; }
Result<std::uint64_t> Executive::inject(const FaultRequest& fault) { return impl_->inject(fault); }
Result<void> Executive::remove_fault(std::uint64_t id) { return impl_->remove_fault(id); }
std::optional<JobView> Executive::job(const std::string& key) const { return impl_->job(key); }
Snapshot Executive::snapshot(std::size_t ended_max) const { return impl_->snapshot(ended_max); }
std::vector<ArmView> Executive::arms() const { return impl_->arms(); }
TimelineView Executive::timeline() const {
  return timeline_of(impl_->scheduler_, impl_->now_, *impl_->cell_, *impl_);
}
TimePoint Executive::now() const { return impl_->now_; }
bool Executive::all_ended() const { return impl_->active_ == 0; }
TimePoint Executive::settled_until() const { return impl_->settled_until(); }
const RunFigures& Executive::figures() const { return impl_->figures_; }
void Executive::tick(TimePoint now) { impl_->tick(now); }

}  // namespace armloom
