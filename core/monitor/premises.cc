#include "core/monitor/premises.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/coordination/tracking_errors.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// The lag of an arm has died out after this many time constants: exp(-20) of 1 rad is 2e-9 rad.
constexpr int kSettles = 20;
// An arm that moved without a motion counts as at rest if it stays within its limit so long.
constexpr Duration kStill = std::chrono::milliseconds(500);

struct Farthest {
  double distance = 0.0;
  std::optional<JointId> joint = {};
};

bool moves(const Trajectory& motion, JointId joint) {
  return std::ranges::count(motion.joints(), joint) > 0;
}

}  // namespace

double PremiseCheck::tracking_error(const Cell& cell, ArmId arm) {
  return cell.tracking_error(cell.arm(arm).robot);
}

double PremiseCheck::velocity_limit(const Cell& cell, JointId joint) {
  return cell.joint(joint).velocity_max * (1.0 + cell.checking.limit_tolerance);
}

PremiseCheck::PremiseCheck(CellPtr cell)
    : cell_(std::move(cell)), arms_(cell_->arms.size(), ArmState{EarliestRest(cell_)}) {
  velocity_ = Configuration::Zero(static_cast<Eigen::Index>(cell_->joints.size()));
  for (std::size_t a = 0; a < arms_.size(); ++a) {
    arms_[a].joints = joints_and_gripper(cell_->arms[a]);
    arms_[a].rest = cell_->home();
    arms_[a].rested = true;
  }
}

std::vector<MonitorFinding> PremiseCheck::check(const Observation& seen) {
  std::vector<MonitorFinding> found;
  for (std::uint32_t a = 0; a < arms_.size(); ++a) {
    const ArmId arm{a};
    ArmState& state = arms_[a];
    state.as_certified = state.keeps_authority = true;
    state.deviation = 0.0;
    if (!seen.arms[a].is_connected) {
      state.rested = false;
      continue;
    }
    if (seen.arms[a].starts != state.last.starts) begin_motion(arm, seen);
    if (!check_feedback(arm, seen, found)) {
      check_path(arm, seen, found);
      check_rest(arm, seen, found);
      check_stop(arm, seen, found);
    }
    state.elsewhere =
        state.moved_at && time_ && std::ranges::all_of(state.joints, [&](JointId joint) {
          return std::abs(seen.measured[joint.value()] - measured_[joint.value()]) <=
                 tracking_error(*cell_, arm);
        });
    state.last = seen.arms[a];
  }
  measured_ = seen.measured;
  time_ = seen.time;
  return found;
}

void PremiseCheck::resumed(ArmId arm) { arms_[arm.index()].violations = {}; }

// Reports a violation when it begins, or goes on after a rest.
void PremiseCheck::judge(ArmId arm, bool holds, bool rests, MonitorFinding finding,
                         std::vector<MonitorFinding>& found) {
  Violation& known = arms_[arm.index()].violations[static_cast<std::size_t>(finding.kind)];
  if (!holds) {
    known.has_rested = known.has_rested || rests;
    return;
  }
  const bool is_known = known.held_at && finding.time - *known.held_at < kSameCondition;
  const bool is_new = !is_known || (known.has_rested && !rests);
  known.has_rested = !is_new && (known.has_rested || rests);
  known.held_at = finding.time;
  if (!is_new) return;
  finding.arm = arm;
  // The link of an arm without reports stops it (core/executive/link_watch.h).
  if (finding.kind != Kind::late_feedback) finding.stops = {arm};
  found.push_back(std::move(finding));
}

// The arm rested before it started, also if no period saw it.
void PremiseCheck::begin_motion(ArmId arm, const Observation& seen) {
  resumed(arm);
  if (!arms_[arm.index()].rested) begin_rest(arm, seen);
}

// ---- Feedback ----

bool PremiseCheck::check_feedback(ArmId arm, const Observation& seen,
                                  std::vector<MonitorFinding>& found) {
  ArmState& state = arms_[arm.index()];
  const ArmObservation& now = seen.arms[arm.index()];
  const Duration timeout = cell_->robots[cell_->arm(arm).robot.index()].controller.feedback_timeout;
  const bool is_late = now.feedback_age > timeout;
  judge(arm, is_late, now.rests,
        {.kind = Kind::late_feedback,
         .time = seen.time,
         .value = to_seconds(now.feedback_age),
         .limit = to_seconds(timeout)},
        found);

  const auto elapsed = since(state.last.reported, now.reported);
  if (time_ && elapsed) check_change(arm, seen, *elapsed, found);
  if (now.motion) state.earliest_rest.observe(now);

  // Positions that stay while the commanded progress goes on.
  const bool changed = !time_ || std::ranges::any_of(state.joints, [&](JointId joint) {
    return seen.measured[joint.value()] != measured_[joint.value()];
  });
  if (changed || now.motion != state.last.motion || now.rests || !now.motion) {
    state.changed_at = seen.time;
    state.commanded_then = now.commanded;
  }
  bool is_frozen = false;
  if (seen.time - state.changed_at > timeout && now.commanded - state.commanded_then > timeout) {
    const double limit = observed_limit(now.off_path, tracking_error(*cell_, arm));
    is_frozen = distance_from_path(*now.motion, state.joints, now.commanded, now.commanded,
                                   seen.measured, limit)
                    .distance > limit;
  }
  judge(arm, is_frozen, now.rests,
        {.kind = Kind::frozen_feedback,
         .time = seen.time,
         .value = to_seconds(seen.time - state.changed_at),
         .limit = to_seconds(timeout)},
        found);
  return is_late;
}

// Finds positions that changed faster than the joints can move. `elapsed`: between the reports.
void PremiseCheck::check_change(ArmId arm, const Observation& seen, Duration elapsed,
                                std::vector<MonitorFinding>& found) {
  ArmState& state = arms_[arm.index()];
  const ArmObservation& now = seen.arms[arm.index()];
  const double elapsed_s = to_seconds(elapsed);
  // Measured with an error twice; an arm that starts off its path approaches it.
  const double slack = 3.0 * tracking_error(*cell_, arm) + now.off_path +
                       std::max(state.deviation, state.last.off_path);
  Farthest far;
  double limit = 0.0, excess = 0.0;
  for (const JointId joint : state.joints) {
    const double change = seen.measured[joint.value()] - measured_[joint.value()];
    velocity_[joint.value()] = change / elapsed_s;
    const double most = velocity_limit(*cell_, joint) * elapsed_s + slack;
    const double by = std::abs(change);
    if (by - most <= excess) continue;
    excess = by - most;
    far = {by, joint};
    limit = most;
  }
  judge(arm, far.joint.has_value(), now.rests,
        {.kind = Kind::implausible_feedback,
         .time = seen.time,
         .joint = far.joint,
         .value = far.distance,
         .limit = limit},
        found);
}

// ---- Positions ----

void PremiseCheck::check_path(ArmId arm, const Observation& seen,
                              std::vector<MonitorFinding>& found) {
  ArmState& state = arms_[arm.index()];
  const ArmObservation& now = seen.arms[arm.index()];
  if (!now.motion || now.rests) {
    judge(arm, false, true, {.kind = Kind::beyond_authority, .time = seen.time}, found);
    // A deviation ends when the arm rests: from then on the rest is checked.
    Violation& known = state.violations[static_cast<std::size_t>(Kind::deviation)];
    if (!now.motion) known = {};
    known.has_rested = true;
    return;
  }
  const double limit = observed_limit(now.off_path, tracking_error(*cell_, arm));
  PathDistance far =
      distance_from_path(*now.motion, state.joints, now.measured,
                         std::max(now.commanded, now.measured), seen.measured, limit);
  double far_limit = limit;
  for (const JointId joint : state.joints) {  // joints that the motion does not move
    if (moves(*now.motion, joint)) continue;
    const double away = std::abs(seen.measured[joint.value()] - state.rest[joint.value()]);
    const double rest_limit = tracking_error(*cell_, arm);
    if (away <= rest_limit || far.distance > far_limit) continue;
    far = {away, joint, now.measured};
    far_limit = rest_limit;
  }
  const bool deviates = far.distance > far_limit;
  if (deviates) state.deviation = far.distance;

  const Duration rests_at = state.earliest_rest.beyond(now);
  state.keeps_authority = rests_at <= now.authority;
  state.as_certified = state.as_certified && !deviates && state.keeps_authority;
  judge(arm, deviates, false,
        {.kind = Kind::deviation,
         .time = seen.time,
         .joint = far.joint,
         .value = far.distance,
         .limit = far_limit},
        found);
  judge(arm, !state.keeps_authority, false,
        {.kind = Kind::beyond_authority,
         .time = seen.time,
         .value = to_seconds(rests_at),
         .limit = to_seconds(now.authority)},
        found);
}

// Returns the longest time from the acknowledgment of a brake until the arm stands. A brake from
// the planned rate takes at most twice the stopping reach; with a payload, it takes longer. Then
// the arm follows its commands until the lag has died out. Without a motion, each joint may have
// its largest velocity.
Duration PremiseCheck::stopping_time(ArmId arm, bool has_motion, double brake) const {
  const ControllerDescription& controller = cell_->robots[cell_->arm(arm).robot.index()].controller;
  Duration braking = has_motion ? 2 * stopping_reach(arm) : Duration{};
  for (const JointId joint : joints(arm)) {
    const double brake_s = velocity_limit(*cell_, joint) / cell_->joint(joint).brake;
    if (!has_motion) braking = std::max(braking, from_seconds(brake_s));
  }
  braking = from_seconds(to_seconds(braking) / (has_motion ? std::sqrt(brake) : brake));
  return controller.reaction + controller.feedback_period + kSettles * controller.lag + braking;
}

void PremiseCheck::check_stop(ArmId arm, const Observation& seen,
                              std::vector<MonitorFinding>& found) {
  ArmState& state = arms_[arm.index()];
  const ArmObservation& now = seen.arms[arm.index()];
  const bool rests = !now.motion || now.rests;
  if (!now.braking_since) {
    state.braking_since.reset();
    return judge(arm, false, rests, {Kind::stop_ignored, seen.time}, found);
  }
  bool moves = false;
  Duration told = seen.time - *now.braking_since;
  const Duration limit = stopping_time(arm, !rests, now.brake);
  if (state.braking_since != now.braking_since) {
    state.braking_since = now.braking_since;
    state.after_brake.begin(*now.braking_since + limit);
  }
  if (!rests) {
    moves = told > limit && std::max(now.commanded, now.measured) >
                                std::max(state.last.commanded, state.last.measured);
    // It may also move beside its path.
    if (since(state.last.reported, now.reported)) {
      moves = state.after_brake.observe(seen.measured, state.joints, tracking_error(*cell_, arm),
                                        seen.time) ||
              moves;
    }
  } else if (since(state.last.reported, now.reported)) {
    told = std::min(told, seen.time - state.braked_at);
    moves =
        state.moves_on.observe(seen.measured, state.joints, tracking_error(*cell_, arm), seen.time);
  }
  judge(arm, moves, rests,
        {.kind = Kind::stop_ignored,
         .time = seen.time,
         .value = to_seconds(told),
         .limit = to_seconds(limit)},
        found);
}

void PremiseCheck::set_rest(ArmState& state, const Configuration& measured) {
  for (const JointId joint : state.joints) state.rest[joint.value()] = measured[joint.value()];
}

PathDistance PremiseCheck::nearest(ArmId arm, const Observation& seen) const {
  const ArmObservation& now = seen.arms[arm.index()];
  return distance_from_path(*now.motion, joints(arm), now.measured,
                            std::max(now.commanded, now.measured), seen.measured, 0.0);
}

// Sets where the arm rests: on its last path, which has no noise, if it is close enough.
void PremiseCheck::begin_rest(ArmId arm, const Observation& seen) {
  ArmState& state = arms_[arm.index()];
  const ArmObservation& now = seen.arms[arm.index()];
  set_rest(state, seen.measured);
  const ArmObservation& on = now.motion ? now : state.last;
  if (!on.motion) return;
  // A released arm went on for a period at most.
  const Duration beyond = now.motion || !time_ ? Duration{} : seen.time - *time_;
  const Duration to = std::min(on.motion->duration(), std::max(on.commanded, on.measured) + beyond);
  const PathDistance near = distance_from_path(*on.motion, state.joints, std::min(on.measured, to),
                                               to, seen.measured, 0.0);
  if (near.distance > tracking_error(*cell_, arm)) return;
  Eigen::VectorXd path;
  on.motion->sample_positions(near.progress, path);
  for (std::size_t row = 0; row < on.motion->joints().size(); ++row) {
    const JointId joint = on.motion->joints()[row];
    if (std::ranges::count(state.joints, joint) == 0) continue;
    state.rest[joint.value()] = path[static_cast<Eigen::Index>(row)];
  }
}

void PremiseCheck::check_rest(ArmId arm, const Observation& seen,
                              std::vector<MonitorFinding>& found) {
  ArmState& state = arms_[arm.index()];
  const ArmObservation& now = seen.arms[arm.index()];
  const bool rests = !now.motion || now.rests;
  const double limit = tracking_error(*cell_, arm);
  if (rests && !state.rested) begin_rest(arm, seen);
  state.rested = rests;
  if (!rests) {
    state.moved_at.reset();
    state.moves_on.end();
    return judge(arm, false, false, {.kind = Kind::unplanned_motion, .time = seen.time}, found);
  }
  Farthest far;
  for (const JointId joint : state.joints) {
    const double away = std::abs(seen.measured[joint.value()] - state.rest[joint.value()]);
    if (away > far.distance) far = {away, joint};
  }
  const bool moved = far.distance > limit;
  if (moved) {
    state.moved_at = seen.time;
    set_rest(state, seen.measured);
  } else if (state.moved_at && seen.time - *state.moved_at >= kStill) {
    state.moved_at.reset();
  }
  state.as_certified = state.as_certified && !state.moved_at;
  const std::size_t before = found.size();
  judge(arm, moved, true,
        {.kind = Kind::unplanned_motion,
         .time = seen.time,
         .joint = far.joint,
         .value = far.distance,
         .limit = limit},
        found);
  // An arm that was stopped before may be moved by a person.
  if (found.size() == before || now.is_stopped) return;
  state.braked_at = seen.time;
  state.moves_on.begin(seen.time + stopping_time(arm, false, seen.arms[arm.index()].brake));
}

std::optional<MonitorFinding> PremiseCheck::finished(ArmId arm, const Trajectory& motion,
                                                     const Configuration& measured,
                                                     TimePoint now) const {
  const double limit = std::max(tracking_error(*cell_, arm), cell_->execution.start_tolerance_rad);
  const PathDistance far = distance_from_path(motion, arms_[arm.index()].joints, motion.duration(),
                                              motion.duration(), measured, limit);
  if (far.distance <= limit) return std::nullopt;
  return MonitorFinding{.kind = Kind::early_finish,
                        .time = now,
                        .stops = {arm},
                        .arm = arm,
                        .joint = far.joint,
                        .value = far.distance,
                        .limit = limit};
}

}  // namespace armloom
