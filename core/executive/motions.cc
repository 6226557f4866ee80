#include "core/executive/motions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/monitor/path_distance.h"
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
      speeds_(controllers.size()),
      measured_(std::move(measured)),
      truth_(measured_) {
  for (std::size_t a = 0; a < controllers.size(); ++a) {
    const Robot& robot = cell_->robots[cell_->arms[a].robot.index()];
    ArmLink link(robot.controller, joints_of(measured_, controllers[a]->joints()));
    arms_.push_back({std::move(controllers[a]), std::move(link)});
  }
}

void Motions::dispatch(const Dispatch& dispatch, const TrajectoryPtr& trajectory) {
  Motion& motion = motions_[dispatch.step];
  motion.trajectory = trajectory;
  motion.authority = dispatch.authority;
  motion.granted_max = std::max(motion.granted_max, motion.authority);
  motion.resting = motion.braking = false;
  motion.handed_on = dispatch.authority;
  if (trajectory->arms().size() > 1) {
    motion.out_of_step = out_of_step(*cell_, *trajectory);
    motion.ahead_max = motion.out_of_step + from_seconds(stopping_reach_s(*cell_, *trajectory));
    motion.handed_on = std::min(dispatch.authority, dispatch.from_progress + motion.ahead_max);
  }
  if (trajectory->arms().size() > 1) pass_on_speed(trajectory->arms());
  for (ArmId arm : trajectory->arms()) {
    ++arms_[arm.index()].starts;
    // An arm that stands ahead of its siblings lets them catch up.
    const auto stands_at = motion.stands_at.find(arm);
    const Duration from =
        stands_at == motion.stands_at.end() ? dispatch.from_progress : stands_at->second;
    command(arm, ArmCommand::Follow{trajectory, dispatch.start_at + (from - dispatch.from_progress),
                                    from, motion.handed_on});
  }
}

void Motions::grant(const Grant& grant) {
  Motion& motion = motions_.at(grant.step);
  motion.authority = grant.authority;
  motion.granted_max = std::max(motion.granted_max, motion.authority);
  if (motion.trajectory->arms().size() > 1) return;  // keep_together() hands it on
  command(motion.trajectory->arms().front(), ArmCommand::Extend{grant.authority});
}

void Motions::brake_all() {
  for (std::uint32_t a = 0; a < arms_.size(); ++a) command(ArmId{a}, ArmCommand::Brake{});
}

void Motions::set_speed(std::vector<ArmCommand::SetSpeed> speeds) {
  speeds_ = std::move(speeds);
  for (std::uint32_t a = 0; a < arms_.size(); ++a) pass_on_speed({ArmId{a}});
  for (const auto& [step, motion] : motions_) {
    if (motion.trajectory->arms().size() > 1) pass_on_speed(motion.trajectory->arms());
  }
}

void Motions::pass_on_speed(const std::vector<ArmId>& together) {
  ArmCommand::SetSpeed smallest;
  for (ArmId arm : together) {
    smallest.share = std::min(smallest.share, speed(arm).share);
    smallest.brake = std::min(smallest.brake, speed(arm).brake);
  }
  for (ArmId arm : together) command(arm, smallest);
}

void Motions::brake(StepId step) {
  Motion& motion = motions_.at(step);
  motion.braking = true;
  for (ArmId arm : motion.trajectory->arms()) command(arm, ArmCommand::Brake{});
}

void Motions::release(StepId step) {
  const auto it = motions_.find(step);
  if (it == motions_.end()) return;
  const std::vector<ArmId>& arms = it->second.trajectory->arms();
  for (ArmId arm : arms) {
    command(arm, ArmCommand::Release{});
    if (arms.size() > 1) pass_on_speed({arm});
  }
  motions_.erase(it);
}

void Motions::tick_arms(TimePoint now) {
  for (LinkedArm& arm : arms_) {
    const Duration before = arm.link.feedback().measured_progress;
    arm.link.exchange(*arm.controller, now);
    const ArmFeedback& feedback = arm.link.feedback();
    const bool moves = feedback.phase == Phase::moving || feedback.phase == Phase::braking;
    arm.advances = feedback.measured_progress != before && moves;
    set_joints(measured_, arm.controller->joints(), feedback.measured);
    const Eigen::VectorXd* truth = arm.controller->true_positions();
    set_joints(truth_, arm.controller->joints(), truth == nullptr ? feedback.measured : *truth);
  }
}

const std::vector<MotionReport>& Motions::tick(TimePoint now) {
  tick_arms(now);
  reports_.clear();
  for (auto& [step, motion] : motions_) {
    report(step, motion);
    if (motion.trajectory->arms().size() > 1 && !motion.resting) keep_together(motion);
  }
  return reports_;
}

void Motions::keep_together(Motion& motion) {
  Duration last = motion.trajectory->duration();
  for (ArmId arm : motion.trajectory->arms()) {
    last = std::min(last, feedback(arm).commanded_progress);
  }
  // In steps, because an arm plans its braking anew for each one.
  const Duration reach = last + motion.ahead_max;
  if (reach >= motion.authority || reach - motion.handed_on >= motion.out_of_step / 2) {
    motion.handed_on = std::min(reach, motion.authority);
  }
  for (ArmId arm : motion.trajectory->arms()) {
    const bool ahead = feedback(arm).commanded_progress - last > motion.out_of_step;
    command(arm, ArmCommand::Extend{ahead ? std::min(last, motion.handed_on) : motion.handed_on});
  }
}

void Motions::report(StepId step, Motion& motion) {
  if (motion.resting) return;
  bool all_rest = true, all_finished = true, any_moves = false;
  const ArmFeedback* fault = nullptr;
  Duration progress = motion.trajectory->duration(), farthest{};
  std::optional<Duration> rests_at = progress;
  for (ArmId arm : motion.trajectory->arms()) {
    const ArmFeedback& said = feedback(arm);
    all_rest = all_rest && at_rest(said.phase);
    all_finished = all_finished && said.phase == Phase::finished;
    any_moves = any_moves || moving(arm);
    if (said.phase == Phase::fault) fault = &said;
    progress = std::min(progress, said.measured_progress);
    farthest = std::max(farthest, said.measured_progress);
    rests_at = rests_at && said.rests_at ? std::min(rests_at, said.rests_at) : std::nullopt;
  }
  // The monitor acts on an arm that passes its authority. The scheduler, which never granted that,
  // sees the arm at its authority.
  progress = std::min(progress, motion.granted_max);
  farthest = std::min(farthest, motion.granted_max);
  if (rests_at) rests_at = std::min(*rests_at, motion.granted_max);
  if (fault && !motion.braking) brake(step);
  if (all_rest) {
    motion.resting = true;
    for (ArmId arm : motion.trajectory->arms()) {
      motion.stands_at[arm] = feedback(arm).measured_progress;
    }
    const auto kind = fault          ? MotionReport::Kind::faulted
                      : all_finished ? MotionReport::Kind::finished
                                     : MotionReport::Kind::stopped;
    reports_.push_back({step, kind, progress, joints_of(measured_, motion.trajectory->joints()),
                        fault ? fault->detail : std::string(), farthest});
  } else if (any_moves) {
    reports_.push_back({.step = step,
                        .kind = MotionReport::Kind::progressed,
                        .progress = progress,
                        .rests_at = rests_at});
  }
}

bool Motions::moving(ArmId arm) const {
  const Phase phase = feedback(arm).phase;
  return phase == Phase::moving || phase == Phase::braking;
}

bool Motions::all_at_rest() const {
  return std::ranges::all_of(arms_, [](const auto& arm) { return arm.link.feedback().at_rest; });
}
bool Motions::all_settled() const {
  return std::ranges::all_of(arms_, [](const auto& arm) { return arm.link.feedback().settled; });
}

Duration Motions::granted(ArmId arm) const {
  for (const auto& [step, motion] : motions_) {
    if (std::ranges::count(motion.trajectory->arms(), arm) > 0) return motion.granted_max;
  }
  return {};
}

TrajectoryPtr Motions::trajectory(ArmId arm) const {
  for (const auto& [step, motion] : motions_) {
    if (std::ranges::count(motion.trajectory->arms(), arm) > 0) return motion.trajectory;
  }
  return nullptr;
}

double Motions::deviation(ArmId arm, double enough) const {
  const TrajectoryPtr motion = trajectory(arm);
  if (!motion) return 0.0;
  const ArmFeedback& said = feedback(arm);
  return distance_from_path(*motion, joints(arm), said.measured_progress,
                            std::max(said.commanded_progress, said.measured_progress), measured_,
                            enough)
      .distance;
}

std::vector<Motions::UnderWay> Motions::under_way() const {
  std::vector<UnderWay> all;
  for (const auto& [step, motion] : motions_) {
    for (ArmId arm : motion.trajectory->arms()) {
      all.push_back({arm, step, feedback(arm).measured_progress, motion.authority});
    }
  }
  return all;
}

}  // namespace armloom
