#include "core/executive/motions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/trajectory/set_joints.h"
#include "core/trajectory/stopping_reach.h"

namespace armloom {
namespace {

using Phase = ArmFeedback::Phase;

bool at_rest(Phase phase) {
  return phase == Phase::stopped || phase == Phase::finished || phase == Phase::fault;
}

}  // namespace

Motions::Motions(CellPtr cell, std::vector<std::unique_ptr<ArmController>> controllers,
                 Configuration measured)
    : cell_(std::move(cell)),
      controllers_(std::move(controllers)),
      feedback_(controllers_.size()),
      advances_(controllers_.size(), false),
      measured_(std::move(measured)) {}

void Motions::dispatch(const Dispatch& dispatch, const TrajectoryPtr& trajectory) {
  Motion& motion = motions_[dispatch.job];
  motion.trajectory = trajectory;
  motion.authority = dispatch.authority;
  motion.resting = motion.braking = false;
  motion.handed_on = dispatch.authority;
  if (trajectory->arms().size() > 1) {
    motion.ahead_max = kOutOfStep + from_seconds(stopping_reach_s(*cell_, *trajectory));
    motion.handed_on = std::min(dispatch.authority, dispatch.from_progress + motion.ahead_max);
  }
  for (ArmId arm : trajectory->arms()) {
    // An arm that stands ahead of its siblings lets them catch up.
    const auto stands_at = motion.stands_at.find(arm);
    const Duration from =
        stands_at == motion.stands_at.end() ? dispatch.from_progress : stands_at->second;
    feedback_[arm.index()].settled = false;  // until its next tick
    controllers_[arm.index()]->start(
        trajectory, dispatch.start_at + (from - dispatch.from_progress), from, motion.handed_on);
  }
}

void Motions::grant(const Grant& grant) {
  Motion& motion = motions_.at(grant.job);
  motion.authority = grant.authority;
  for (ArmId arm : motion.trajectory->arms()) feedback_[arm.index()].settled = false;
  if (motion.trajectory->arms().size() > 1) return;  // keep_together() hands it on
  for (ArmId arm : motion.trajectory->arms()) controllers_[arm.index()]->grant(grant.authority);
}

void Motions::brake_all() {
  for (const auto& controller : controllers_) controller->brake();
}

void Motions::brake(JobId job) {
  Motion& motion = motions_.at(job);
  motion.braking = true;
  for (ArmId arm : motion.trajectory->arms()) {
    feedback_[arm.index()].settled = false;
    controllers_[arm.index()]->brake();
  }
}

void Motions::release(JobId job) {
  const auto it = motions_.find(job);
  if (it == motions_.end()) return;
  for (ArmId arm : it->second.trajectory->arms()) controllers_[arm.index()]->release();
  motions_.erase(it);
}

void Motions::tick_arms(TimePoint now) {
  for (std::uint32_t a = 0; a < controllers_.size(); ++a) {
    const Duration before = feedback_[a].measured_progress;
    feedback_[a] = controllers_[a]->tick(now);
    advances_[a] = feedback_[a].measured_progress != before && moving(ArmId{a});
    const auto& joints = controllers_[a]->joints();
    for (std::size_t j = 0; j < joints.size(); ++j) {
      measured_[static_cast<Eigen::Index>(joints[j].index())] =
          feedback_[a].measured[static_cast<Eigen::Index>(j)];
    }
  }
}

const std::vector<MotionReport>& Motions::tick(TimePoint now) {
  tick_arms(now);
  reports_.clear();
  for (auto& [job, motion] : motions_) {
    report(job, motion);
    if (motion.trajectory->arms().size() > 1 && !motion.resting) keep_together(motion);
  }
  return reports_;
}

void Motions::keep_together(Motion& motion) {
  Duration last = motion.trajectory->duration();
  for (ArmId arm : motion.trajectory->arms()) {
    last = std::min(last, feedback_[arm.index()].commanded_progress);
  }
  // In steps, as an arm plans its brake anew for each one.
  const Duration reach = last + motion.ahead_max;
  if (reach >= motion.authority || reach - motion.handed_on >= kOutOfStep / 2) {
    motion.handed_on = std::min(reach, motion.authority);
  }
  for (ArmId arm : motion.trajectory->arms()) {
    const bool ahead = feedback_[arm.index()].commanded_progress - last > kOutOfStep;
    controllers_[arm.index()]->grant(ahead ? std::min(last, motion.handed_on) : motion.handed_on);
  }
}

void Motions::report(JobId job, Motion& motion) {
  if (motion.resting) return;
  bool all_rest = true, all_finished = true, any_moves = false;
  const ArmFeedback* fault = nullptr;
  Duration progress = motion.trajectory->duration(), farthest{};
  std::optional<Duration> rests_at = progress;
  for (ArmId arm : motion.trajectory->arms()) {
    const ArmFeedback& feedback = feedback_[arm.index()];
    all_rest = all_rest && at_rest(feedback.phase);
    all_finished = all_finished && feedback.phase == Phase::finished;
    any_moves = any_moves || moving(arm);
    if (feedback.phase == Phase::fault) fault = &feedback;
    progress = std::min(progress, feedback.measured_progress);
    farthest = std::max(farthest, feedback.measured_progress);
    rests_at = rests_at && feedback.rests_at ? std::min(rests_at, feedback.rests_at) : std::nullopt;
  }
  if (fault && !motion.braking) brake(job);
  if (all_rest) {
    motion.resting = true;
    for (ArmId arm : motion.trajectory->arms()) {
      motion.stands_at[arm] = feedback_[arm.index()].measured_progress;
    }
    const auto kind = fault          ? MotionReport::Kind::faulted
                      : all_finished ? MotionReport::Kind::finished
                                     : MotionReport::Kind::stopped;
    reports_.push_back({job, kind, progress, joints_of(measured_, motion.trajectory->joints()),
                        fault ? fault->detail : std::string(), farthest});
  } else if (any_moves) {
    reports_.push_back({.job = job,
                        .kind = MotionReport::Kind::progressed,
                        .progress = progress,
                        .rests_at = rests_at});
  }
}

bool Motions::moving(ArmId arm) const {
  const Phase phase = feedback_[arm.index()].phase;
  return phase == Phase::moving || phase == Phase::braking;
}

bool Motions::all_at_rest() const { return std::ranges::all_of(feedback_, &ArmFeedback::at_rest); }
bool Motions::all_settled() const { return std::ranges::all_of(feedback_, &ArmFeedback::settled); }

double Motions::deviation(ArmId arm) const {
  for (const auto& [job, motion] : motions_) {
    const auto& arms = motion.trajectory->arms();
    if (std::ranges::find(arms, arm) == arms.end()) continue;
    Eigen::VectorXd path;
    motion.trajectory->sample_positions(feedback_[arm.index()].measured_progress, path);
    double largest = 0.0;
    for (std::size_t j = 0; j < motion.trajectory->joints().size(); ++j) {
      const JointId joint = motion.trajectory->joints()[j];
      if (cell_->joint(joint).arm != arm) continue;
      largest = std::max(largest, std::abs(measured_[static_cast<Eigen::Index>(joint.index())] -
                                           path[static_cast<Eigen::Index>(j)]));
    }
    return largest;
  }
  return 0.0;
}

std::vector<Motions::UnderWay> Motions::under_way() const {
  std::vector<UnderWay> all;
  for (const auto& [job, motion] : motions_) {
    for (ArmId arm : motion.trajectory->arms()) {
      all.push_back({arm, job, feedback_[arm.index()].measured_progress, motion.authority});
    }
  }
  return all;
}

}  // namespace armloom
