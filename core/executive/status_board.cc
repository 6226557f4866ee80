#include "core/executive/status_board.h"

#include <algorithm>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/queue_lists.h"

namespace armloom {

JobSheet::JobPtr Status::with_progress(const JobSheet::JobPtr& job) const {
  const auto on_it = std::ranges::find(arms, std::optional(job->id), &ArmStatus::job);
  if (on_it == arms.end() || is_terminal(job->state) || on_it->progress == job->motion.progress) {
    return job;
  }
  JobView view = *job;
  view.motion.progress = on_it->progress;
  return std::make_shared<const JobView>(std::move(view));
}

std::vector<JobSheet::JobPtr> Status::jobs_with_ended(std::size_t ended_max) const {
  std::vector<JobSheet::JobPtr> found, ended;
  jobs.each([&](const JobSheet::JobPtr& job) {
    if (is_terminal(job->state)) {
      ended.push_back(job);
    } else {
      found.push_back(with_progress(job));
    }
  });
  if (ended.size() > ended_max) {
    std::ranges::stable_sort(ended, {}, [](const auto& job) { return *job->times.ended_at; });
    ended.erase(ended.begin(), ended.end() - static_cast<std::ptrdiff_t>(ended_max));
  }
  found.insert(found.end(), ended.begin(), ended.end());
  std::ranges::sort(found, {}, [](const auto& job) { return job->id; });
  return found;
}

ArmView view_of(const ArmStatus& status, ArmId id, const Cell& cell, const Configuration& q,
                std::string job_key) {
  const Arm& arm = cell.arm(id);
  ArmView view{.name = arm.name,
               .robot = cell.robots[arm.robot.index()].name,
               .state = status.state,
               .job = std::move(job_key),
               .progress = status.progress,
               .home = {arm.home.begin(), arm.home.end()},
               .deviation_rad = status.deviation_rad,
               .deviation_max_rad = status.deviation_max_rad,
               .link = status.link,
               .link_detail = status.link_detail,
               .drives_on = status.drives_on,
               .stop_cause = status.stop_cause,
               .speed_override = status.speed_override,
               .effective_speed_override = status.effective_speed_override};
  for (JointId joint : arm.joints) {
    view.joints.push_back(cell.joint(joint).name);
    view.q.push_back(q[static_cast<Eigen::Index>(joint.index())]);
  }
  return view;
}

std::vector<ArmView> arms_of(const Status& status, const Cell& cell) {
  std::vector<ArmView> arms;
  for (ArmId arm : all_arms(cell)) {
    const ArmStatus& now = status.arms[arm.index()];
    const JobSheet::JobPtr job = now.job ? status.jobs.find(*now.job) : nullptr;
    arms.push_back(view_of(now, arm, cell, status.q, job ? job->key : std::string()));
  }
  return arms;
}

QueueView queue_of(const Status& status) {
  QueueView view{
      .policy = status.policy, .stopped = status.stopped, .speed_override = status.speed_override};
  status.jobs.each([&](const JobSheet::JobPtr& job) {
    if (const auto list = queue_list_of(job->state)) (view.*list).push_back(job->key);
  });
  return view;
}

Snapshot snapshot_of(const Status& status, const Cell& cell) {
  return {.seq = status.seq,
          .time = status.time,
          .queue = queue_of(status),
          .scene = *status.scene,
          .arms = arms_of(status, cell),
          .signals = *status.signals,
          .jobs = {}};
}

Status StatusBoard::read() const {
  const std::scoped_lock lock(mutex_);
  return status_;
}

JobSheet::JobPtr StatusBoard::job(const std::string& key) const { return jobs({key}).front(); }

std::vector<JobSheet::JobPtr> StatusBoard::jobs(const std::vector<std::string>& keys) const {
  std::vector<std::optional<JobId>> ids;
  ids.reserve(keys.size());
  const Status status = [&] {
    const std::scoped_lock lock(mutex_);
    for (const std::string& key : keys) {
      const auto id = keys_.find(key);
      ids.push_back(id == keys_.end() ? std::nullopt : std::optional(id->second));
    }
    return status_;
  }();
  std::vector<JobSheet::JobPtr> all;
  for (const auto& id : ids) {
    const JobSheet::JobPtr job = id ? status.jobs.find(*id) : nullptr;
    all.push_back(job ? status.with_progress(job) : nullptr);
  }
  return all;
}

void StatusBoard::publish(const Now& now, const std::vector<KeyOfJob>& gone) {
  JobSheet before = now.jobs;  // freed outside the lock
  const std::scoped_lock lock(mutex_);
  std::swap(status_.jobs, before);
  status_.seq = now.seq;
  status_.time = now.time;
  status_.policy = now.policy;
  status_.stopped = now.stopped;
  status_.speed_override = now.speed_override;
  status_.q = now.q;
  status_.arms = now.arms;
  for (const auto& [key, job] : gone) {
    const auto known = keys_.find(key);
    if (known != keys_.end() && known->second == job) keys_.erase(known);
  }
}

void StatusBoard::publish_scene(std::shared_ptr<const SceneView> scene) {
  const std::scoped_lock lock(mutex_);
  std::swap(status_.scene, scene);
}

void StatusBoard::publish_signals(std::shared_ptr<const std::vector<SignalView>> signals) {
  const std::scoped_lock lock(mutex_);
  std::swap(status_.signals, signals);
}

void StatusBoard::add_key(const std::string& key, JobId job) {
  const std::scoped_lock lock(mutex_);
  keys_.insert_or_assign(key, job);
}

}  // namespace armloom
