// What clients are told, and what they see when they ask.
#include <algorithm>
#include <utility>

#include "core/executive/executive_impl.h"

namespace armloom {

void Executive::Impl::tell(
    std::variant<JobView, ArmView, QueueView, SceneView, MonitorEvent, Alert> body) {
  observer_.on_event(Event{++seq_, now_, std::move(body)});
}

std::string Executive::Impl::key(JobId job) const {
  const auto label = labels_.find(job);
  return label == labels_.end() ? std::string() : label->second.key;
}

std::string Executive::Impl::name(JobId job) const {
  const auto label = labels_.find(job);
  return label == labels_.end() ? std::string() : label->second.name;
}

bool Executive::Impl::has_job(ArmId arm) const {
  return std::ranges::any_of(scheduler_.active(), [&](JobId job) {
    const auto& arms = scheduler_.find(job)->trajectory->arms();
    return std::ranges::find(arms, arm) != arms.end();
  });
}

bool Executive::Impl::is_stopped(ArmId arm) const { return scheduler_.stopped(arm); }

void Executive::Impl::tell_job(JobId job) {
  JobView view = this->view(*scheduler_.find(job));
  if (is_terminal(view.state)) count(view);
  std::optional<Alert> alert;
  if (view.state == JobState::failed || view.state == JobState::expired) {
    alert = Alert{Alert::Level::warning,
                  "job " + view.key + " " + to_string(view.state) + ": " +
                      (view.detail.empty() ? to_string(*view.reason) : view.detail)};
  }
  tell(std::move(view));
  if (alert) tell(std::move(*alert));
}

void Executive::Impl::count(const JobView& ended) {
  figures_.last_end = std::max(figures_.last_end, *ended.ended_at);
  if (const auto plan = plans_.find(ended.id); plan != plans_.end()) *plan->second = true;
  ended_.push_back(ended.id);
  starts_.erase(ended.id);
  --active_;
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

void Executive::Impl::tell_stops() {
  std::vector<ArmId> stops = all_arms();
  std::erase_if(stops, [&](ArmId arm) { return !scheduler_.stopped(arm); });
  if (stops == told_stops_) return;
  told_stops_ = std::move(stops);
  observer_.on_stops(told_stops_);
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
    switch (scheduler_.find(id)->state()) {
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

// Of a job that has not begun: it may not leave where it stands before that is on disk.
bool Executive::Impl::is_told_of_a_start(ArmId arm) const {
  const auto job = scheduler_.occupant(arm);
  return job && starts_.contains(*job) && !scheduler_.find(*job)->has_started();
}

ArmState Executive::Impl::state_of(ArmId arm) const {
  using Phase = ArmFeedback::Phase;
  const Phase phase = motions_.feedback(arm).phase;
  if (phase == Phase::fault) return ArmState::fault;
  if (const auto job = scheduler_.occupant(arm); job && scheduler_.find(*job)->pausing()) {
    return ArmState::holding;
  }
  if (motions_.moving(arm) && !is_told_of_a_start(arm)) return ArmState::moving;
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

std::string Executive::Impl::names_of(const std::vector<ArmId>& arms) const {
  std::string names;
  for (ArmId arm : arms) names += (names.empty() ? "" : ", ") + cell_->arm(arm).name;
  return names;
}

bool Executive::Impl::any_moving() const {
  return std::ranges::any_of(all_arms(), [this](ArmId arm) { return motions_.moving(arm); });
}

std::optional<JobView> Executive::Impl::job(const std::string& key) const {
  const auto it = ids_.find(key);
  if (it == ids_.end()) return std::nullopt;
  return view(*scheduler_.find(it->second));
}

TrajectoryPtr Executive::Impl::trajectory(const std::string& key) const {
  const auto it = ids_.find(key);
  return it == ids_.end() ? nullptr : scheduler_.find(it->second)->trajectory;
}

std::vector<ArmAuthority> Executive::Impl::authorities() const {
  std::vector<ArmAuthority> all;
  for (const Motions::UnderWay& motion : motions_.under_way()) {
    all.push_back(
        {cell_->arm(motion.arm).name, key(motion.job), motion.progress, motion.authority});
  }
  return all;
}

std::vector<ArmView> Executive::Impl::arms() const {
  std::vector<ArmView> arms;
  for (ArmId arm : all_arms()) arms.push_back(view_of_arm(arm));
  return arms;
}

Snapshot Executive::Impl::snapshot(std::size_t ended_max) const {
  Snapshot snapshot{.seq = seq_, .time = now_, .queue = queue(), .arms = arms()};
  snapshot.scene = SceneView{scene_version_, scene_->objects()};
  for (std::size_t i = ended_.size() - std::min(ended_max, ended_.size()); i < ended_.size(); ++i) {
    snapshot.jobs.push_back(view(*scheduler_.find(ended_[i])));
  }
  for (JobId id : scheduler_.active()) {
    snapshot.jobs.push_back(view(*scheduler_.find(id)));
  }
  std::ranges::sort(snapshot.jobs, {}, &JobView::id);
  return snapshot;
}

}  // namespace armloom
