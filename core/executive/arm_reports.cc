#include "core/executive/arm_reports.h"

#include <algorithm>
#include <string>

#include "core/executive/arms_of.h"

namespace armloom {

ArmReports::ArmReports(const Shown& shown)
    : shown_(shown), present_(shown.cell.arms.size()), told_(shown.cell.arms.size()) {}

void ArmReports::look() {
  for (ArmId arm : all_arms(shown_.cell)) present_[arm.index()] = status_of(arm);
}

std::vector<ArmView> ArmReports::take_changed() {
  std::vector<ArmView> changed;
  for (ArmId arm : all_arms(shown_.cell)) {
    const ArmStatus& status = present_[arm.index()];
    ArmStatus& told = told_[arm.index()];
    const bool is_same = status.state == told.state && status.job == told.job &&
                         status.link == told.link && status.drives_on == told.drives_on &&
                         status.stop_cause == told.stop_cause &&
                         status.speed_override == told.speed_override &&
                         status.effective_speed_override == told.effective_speed_override;
    if (is_same) continue;
    told = status;
    changed.push_back(view_of_arm(arm, status));
  }
  return changed;
}

std::vector<ArmView> ArmReports::views() const {
  std::vector<ArmView> views;
  for (ArmId arm : all_arms(shown_.cell)) views.push_back(view_of_arm(arm, status_of(arm)));
  return views;
}

bool ArmReports::all_stopped() const {
  return std::ranges::all_of(all_arms(shown_.cell),
                             [this](ArmId arm) { return shown_.scheduler.stopped(arm); });
}

std::vector<ArmAuthority> ArmReports::authorities() const {
  std::vector<ArmAuthority> all;
  for (const Motions::UnderWay& motion : shown_.motions.under_way()) {
    all.push_back({shown_.cell.arm(motion.arm).name, shown_.jobs.key(motion.step.job),
                   motion.progress, motion.authority});
  }
  return all;
}

// Returns true if the arm has a job that has not begun: the arm stays until the start is stored.
bool ArmReports::is_told_of_a_start(ArmId arm) const {
  const auto job = shown_.scheduler.occupant(arm);
  return job && shown_.starts.knows(*job) && !shown_.scheduler.find(*job)->times.started_at;
}

// Returns the job of the arm: the one in motion, or one with steps that has begun and waits between
// its motions; nullopt if there is none.
std::optional<JobId> ArmReports::job_of(ArmId arm) const {
  if (const auto job = shown_.scheduler.occupant(arm)) return job;
  const auto next = shown_.scheduler.head(arm);
  const Task* task = next ? shown_.tasks.find(*next) : nullptr;
  return task != nullptr && task->began_at && !task->end ? next : std::nullopt;
}

ArmState ArmReports::state_of(ArmId arm) const {
  using Phase = ArmFeedback::Phase;
  const Phase phase = shown_.motions.feedback(arm).phase;
  if (phase == Phase::fault) return ArmState::fault;
  // A lost arm has come to rest, or will do so; what it does is not known.
  const bool is_lost = shown_.motions.link(arm).state() == ArmLink::State::lost;
  const bool moves = shown_.motions.moving(arm) && !is_lost && !is_told_of_a_start(arm);
  if (shown_.scheduler.stopped(arm) && !moves) return ArmState::stopped;
  const auto job = shown_.scheduler.occupant(arm);
  if (job && shown_.scheduler.find(*job)->pausing()) return ArmState::paused;
  if (moves) return ArmState::moving;
  const bool waits = job ? phase == Phase::stopped : job_of(arm).has_value();
  return waits ? ArmState::paused : ArmState::idle;
}

ArmStatus ArmReports::status_of(ArmId arm) const {
  const double deviation_max_rad = present_[arm.index()].deviation_max_rad;
  ArmStatus status{.state = state_of(arm),
                   .stopped = shown_.scheduler.stopped(arm),
                   .deviation_rad = shown_.motions.deviation(arm, deviation_max_rad),
                   .link = shown_.motions.link(arm).state(),
                   .link_detail = shown_.motions.link(arm).detail(),
                   .drives_on = shown_.motions.feedback(arm).drives_on,
                   .speed_override = shown_.scheduler.state().speed.arm(arm),
                   .effective_speed_override = shown_.scheduler.state().speed.effective(arm)};
  if (const auto& stop = shown_.scheduler.state().arms.stop_of(arm))
    status.stop_cause = stop->cause;
  status.deviation_max_rad = std::max(deviation_max_rad, status.deviation_rad);
  status.job = job_of(arm);
  if (const auto job = shown_.scheduler.occupant(arm)) {
    const Step& step = *shown_.scheduler.find(*job);
    status.progress = to_seconds(step.progress) / to_seconds(step.trajectory->duration());
  }
  return status;
}

ArmView ArmReports::view_of_arm(ArmId arm, const ArmStatus& status) const {
  return view_of(status, arm, shown_.cell, shown_.motions.measured(),
                 status.job ? shown_.jobs.key(*status.job) : std::string());
}

}  // namespace armloom
