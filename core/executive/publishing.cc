#include "core/executive/publishing.h"

#include <algorithm>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/guard_words.h"

namespace armloom {

Publisher::Publisher(const Shown& shown, Observer& observer)
    : shown_(shown),
      observer_(observer),
      told_arms_(shown.cell.arms.size(), ArmState::idle),
      told_arm_jobs_(shown.cell.arms.size()),
      told_queue_(queue()) {}

void Publisher::tell(Body body, TimePoint now) {
  observer_.on_event(Event{++seq_, now, std::move(body)});
}

void Publisher::tell_job(JobView view, TimePoint now) {
  std::optional<Alert> alert;
  if (view.state == JobState::failed || view.state == JobState::expired) {
    alert = Alert{Alert::Level::warning,
                  "job " + view.key + " " + to_string(view.state) + ": " +
                      (view.detail().empty() ? to_string(*view.reason()) : view.detail())};
  }
  tell(std::move(view), now);
  if (alert) tell(std::move(*alert), now);
}

void Publisher::tell_tick(TimePoint now) {
  if (const bool at_rest = shown_.motions.all_at_rest(); at_rest != told_rest_) {
    told_rest_ = at_rest;
    observer_.on_rest(at_rest);
  }
  observer_.on_tick(now, shown_.motions.measured());
}

void Publisher::tell_arms(TimePoint now) {
  for (ArmId arm : all_arms(shown_.cell)) {
    const ArmState state = state_of(arm);
    const auto occupant = shown_.scheduler.occupant(arm);
    const std::string job = occupant ? shown_.jobs.key(*occupant) : std::string();
    if (state == told_arms_[arm.index()] && job == told_arm_jobs_[arm.index()]) continue;
    told_arms_[arm.index()] = state;
    told_arm_jobs_[arm.index()] = job;
    tell(view_of_arm(arm), now);
  }
}

void Publisher::tell_stops() {
  std::vector<ArmId> stops = all_arms(shown_.cell);
  std::erase_if(stops, [&](ArmId arm) { return !shown_.scheduler.stopped(arm); });
  if (stops == told_stops_) return;
  told_stops_ = std::move(stops);
  observer_.on_stops(told_stops_);
}

void Publisher::queue_may_have_changed(TimePoint now) {
  queue_is_old_ = true;
  tell_queue(now);
}

void Publisher::tell_queue(TimePoint now) {
  if (!queue_is_old_) return;
  if (now < next_queue_) return tell_stopped(now);
  queue_is_old_ = false;
  QueueView present = queue();
  const std::size_t jobs = shown_.jobs.active();
  next_queue_ = jobs < kShortQueue ? now : now + static_cast<Duration::rep>(jobs) * kForEachJob;
  if (present == told_queue_) return;
  told_queue_ = present;
  tell(std::move(present), now);
}

// With the lists as they were told: to make those of thousands takes longer than all else of a
// stop.
void Publisher::tell_stopped(TimePoint now) {
  const bool stopped = all_stopped();
  if (std::exchange(told_queue_.stopped, stopped) != stopped) tell(told_queue_, now);
}

bool Publisher::all_stopped() const {
  return std::ranges::all_of(all_arms(shown_.cell),
                             [this](ArmId arm) { return shown_.scheduler.stopped(arm); });
}

void Publisher::tell_state(const std::vector<Proximity>& near, TimePoint now) {
  observer_.on_state(StateFrame{now, shown_.motions.measured(), near, authorities()});
}

std::vector<ArmAuthority> Publisher::authorities() const {
  std::vector<ArmAuthority> all;
  for (const Motions::UnderWay& motion : shown_.motions.under_way()) {
    all.push_back({shown_.cell.arm(motion.arm).name, shown_.jobs.key(motion.job), motion.progress,
                   motion.authority});
  }
  return all;
}

JobView Publisher::view(JobId id) const {
  JobView view = view_of(*shown_.scheduler.find(id), shown_.cell, shown_.jobs);
  const JobLabel* label = shown_.jobs.label(id);
  if (label != nullptr && label->submitted_at) view.times.submitted_at = *label->submitted_at;
  if (const auto refusal = shown_.gate.refusal(id)) {
    WaitView& wait = view.waits_on.emplace_back(WaitView{.kind = Wait::Kind::guard});
    if (refusal->other) wait.arm = shown_.cell.arm(*refusal->other).name;
    wait.detail = sentence(*refusal, shown_.cell);
  }
  return view;
}

QueueView Publisher::queue() const {
  QueueView view{.policy = std::string(shown_.scheduler.policy().name())};
  view.stopped = all_stopped();
  for (JobId id : shown_.scheduler.active()) {
    switch (shown_.scheduler.find(id)->state()) {
      case JobState::queued:
        view.queued.push_back(shown_.jobs.key(id));
        break;
      case JobState::backlogged:
        view.backlog.push_back(shown_.jobs.key(id));
        break;
      case JobState::scheduled:
        view.scheduled.push_back(shown_.jobs.key(id));
        break;
      default:
        view.running.push_back(shown_.jobs.key(id));
        break;
    }
  }
  return view;
}

// Of a job that has not begun: it may not leave where it stands before that is on disk.
bool Publisher::is_told_of_a_start(ArmId arm) const {
  const auto job = shown_.scheduler.occupant(arm);
  return job && shown_.starts.knows(*job) && !shown_.scheduler.find(*job)->times.started_at;
}

ArmState Publisher::state_of(ArmId arm) const {
  using Phase = ArmFeedback::Phase;
  const Phase phase = shown_.motions.feedback(arm).phase;
  if (phase == Phase::fault) return ArmState::fault;
  const bool moves = shown_.motions.moving(arm) && !is_told_of_a_start(arm);
  if (shown_.scheduler.stopped(arm) && !moves) return ArmState::stopped;
  const auto job = shown_.scheduler.occupant(arm);
  if (job && shown_.scheduler.find(*job)->pausing()) return ArmState::holding;
  if (moves) return ArmState::moving;
  return job && phase == Phase::stopped ? ArmState::holding : ArmState::idle;
}

ArmView Publisher::view_of_arm(ArmId id) const {
  const Arm& arm = shown_.cell.arm(id);
  ArmView view{.name = arm.name,
               .robot = shown_.cell.robots[arm.robot.index()].name,
               .state = state_of(id),
               .home = {arm.home.begin(), arm.home.end()},
               .deviation_rad = shown_.motions.deviation(id)};
  if (const auto job = shown_.scheduler.occupant(id)) {
    view.job = shown_.jobs.key(*job);
    const Job& j = *shown_.scheduler.find(*job);
    view.progress = to_seconds(j.progress) / to_seconds(j.trajectory->duration());
  }
  for (JointId joint : arm.joints) {
    view.joints.push_back(shown_.cell.joint(joint).name);
    view.q.push_back(shown_.motions.measured()[static_cast<Eigen::Index>(joint.index())]);
  }
  return view;
}

std::vector<ArmView> Publisher::arms() const {
  std::vector<ArmView> arms;
  for (ArmId arm : all_arms(shown_.cell)) arms.push_back(view_of_arm(arm));
  return arms;
}

}  // namespace armloom
