#include "core/scheduler/rejoining.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/scheduler/ways/replanning.h"

namespace armloom {
namespace {

// An arm of a team may rest ahead of the job's progress. It is compared with the path up to there,
// at points this far apart.
constexpr Duration kAheadStep = std::chrono::milliseconds(1);

struct OffPath {
  double distance = 0.0;
  JointId joint{0};
  double path = 0.0;  // where the joint should be
};

OffPath off_path_at(const State& state, ArmId arm, const Trajectory& motion, Duration progress) {
  Eigen::VectorXd path;
  motion.sample_positions(progress, path);
  OffPath far;
  for (std::size_t j = 0; j < motion.joints().size(); ++j) {
    const JointId joint = motion.joints()[j];
    if (state.cell->joint(joint).arm != arm) continue;
    const double on_path = path[static_cast<Eigen::Index>(j)];
    const double off =
        std::abs(state.arms.rest()[static_cast<Eigen::Index>(joint.index())] - on_path);
    if (off > far.distance) far = {off, joint, on_path};
  }
  return far;
}

OffPath nearest_on_path(const State& state, ArmId arm, const Step& step) {
  const Trajectory& motion = *step.trajectory;
  OffPath nearest = off_path_at(state, arm, motion, step.progress);
  for (Duration at = step.progress; at < step.farthest;) {
    at = std::min(at + kAheadStep, step.farthest);
    const OffPath one = off_path_at(state, arm, motion, at);
    if (one.distance < nearest.distance) nearest = one;
  }
  return nearest;
}

}  // namespace

void rejoin(Transitions& state, ArmId arm) {
  const auto& queue = state->jobs.queues()[arm];
  if (queue.empty() || state->arms.is_stopped(arm)) return;
  const Step& step = state->jobs.at(queue.front());
  if (!step.has_started() || step.is_in_motion()) return;
  const OffPath off = nearest_on_path(state, arm, step);
  if (off.distance <= state->cell->execution.start_tolerance_rad) {
    const bool is_within = off.distance <= state->cell->tracking_error(state->cell->arm(arm).robot);
    if (is_within || off.distance <= step.off_path) return;
    state.jobs().set_off_path(step, off.distance);
    // Its orders assume a motion that is nearer to its path.
    if (state->graph.holds(step.id)) state.withdraw(step, {});
    return;
  }
  const bool rejoins = step.goal || step.job->terms.move_to_start == MoveToStart::plan;
  if (rejoins && !why_not_replanned(step)) {
    return ask_for_another_way(state, step, AnotherWay::Cause::blocked);
  }
  state.give_up(step, {.then = AfterStop::Then::fail,
                       .reason = Reason::start_mismatch,
                       .detail = *rest_beside_path(state, step)});
}

std::optional<std::string> rest_beside_path(const State& state, const Step& step) {
  if (!step.has_started()) return std::nullopt;
  for (const ArmId arm : step.trajectory->arms()) {
    const OffPath off = nearest_on_path(state, arm, step);
    if (off.distance <= state.cell->execution.start_tolerance_rad) continue;
    char text[256];
    std::snprintf(text, sizeof text,
                  "the arm left its path, or was moved while it was stopped: %s is at %.6g, its "
                  "path at %.6g",
                  state.cell->joint(off.joint).name.c_str(),
                  state.arms.rest()[static_cast<Eigen::Index>(off.joint.index())], off.path);
    return text;
  }
  return std::nullopt;
}

void decide_again_beside(Transitions& state, ArmId arm) {
  for (const Step& step : state->jobs.past_queue_now()) {
    if (!step.has_authority() || !state->graph.is_held_by(step.id, {arm})) continue;
    state.brake(step, {.then = AfterStop::Then::decide_again});
  }
}

}  // namespace armloom
