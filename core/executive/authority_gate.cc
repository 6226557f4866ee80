#include "core/executive/authority_gate.h"

#include <algorithm>
#include <utility>

#include "core/coordination/effort.h"
#include "core/coordination/tracking_errors.h"
#include "core/executive/arms_of.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

using Why = GuardRefusal::Why;

std::vector<AuthorityGuard::GuardedArm> guarded_arms(const Cell& cell) {
  std::vector<AuthorityGuard::GuardedArm> arms;
  for (const Arm& arm : cell.arms) {
    const Promises promises = promises_of(cell.robots[arm.robot.index()].controller);
    arms.push_back({joints_and_gripper(arm), promises.report_age()});
  }
  return arms;
}

bool is_at_rest(ArmFeedback::Phase phase) {
  using Phase = ArmFeedback::Phase;
  return phase != Phase::waiting && phase != Phase::moving && phase != Phase::braking;
}

}  // namespace

AuthorityGate::AuthorityGate(CellPtr cell, Motions& motions, SceneFingerprint present, Calls calls)
    : cell_(std::move(cell)),
      motions_(motions),
      guard_(guarded_arms(*cell_), motions.measured(), std::move(present)),
      calls_(std::move(calls)),
      steps_(cell_->arms.size()) {
  for (const ArmId arm : all_arms(*cell_)) guard_.forget_position(arm);
}

void AuthorityGate::certified(const std::vector<Certificate>& certificates) {
  const auto asked = kept_.find(*std::exchange(asked_, std::nullopt));
  if (asked != kept_.end()) ++asked->second.answers;
  take(certificates);
}

// The open answer is about the previous scene, so it is not counted.
void AuthorityGate::look_at(const SceneFingerprint& present) {
  guard_.look_at(present);
  for (auto& [step, kept] : kept_) kept.answers = asked_ == step ? -1 : 0;
}

std::optional<GuardRefusal> AuthorityGate::passes(const TrajectoryPtr& motion,
                                                  AuthorityGuard::From from, Duration authority) {
  if (is_certified_) return guard_.grant(motion, from, authority);
  guard_.hold(motion, from, authority);
  return std::nullopt;
}

void AuthorityGate::dispatch(const Dispatch& dispatch, const TrajectoryPtr& motion) {
  told_[dispatch.step] = motion;
  for (const ArmId arm : motion->arms()) steps_[arm.index()] = dispatch.step;
  const auto refusal = passes(motion, dispatch.from_progress, dispatch.authority);
  if (refusal) return keep(dispatch.step, {motion, dispatch.authority, *refusal, now_, dispatch});
  motions_.dispatch(dispatch, motion);
}

void AuthorityGate::grant(const Grant& grant) {
  const auto before = kept_.find(grant.step);
  if (before != kept_.end()) {
    before->second.authority = std::max(before->second.authority, grant.authority);
    return;
  }
  const TrajectoryPtr& motion = told_.at(grant.step);
  const auto refusal = passes(motion, std::nullopt, grant.authority);
  if (refusal) return keep(grant.step, {motion, grant.authority, *refusal, now_});
  motions_.grant(grant);
}

void AuthorityGate::brake(StepId step) {
  const auto kept = kept_.find(step);
  if (kept != kept_.end() && kept->second.start) {
    kept->second.is_braked = true;
    return;
  }
  if (kept != kept_.end()) kept_.erase(kept);
  motions_.brake(step);
}

void AuthorityGate::release(StepId step) {
  kept_.erase(step);
  told_.erase(step);
  motions_.release(step);
}

void AuthorityGate::keep(StepId step, Kept kept) {
  Kept& now = kept_.insert_or_assign(step, std::move(kept)).first->second;
  if (now.refusal.why != Why::uncertified) report(step, now);
}

void AuthorityGate::report(StepId step, Kept& kept) {
  if (std::exchange(kept.is_reported, true)) return;
  calls_.refused(step, kept.refusal);
}

// ---- Each control cycle ----

const std::vector<MotionReport>& AuthorityGate::tick(TimePoint now) {
  now_ = now;
  reports_ = motions_.tick(now);
  see_positions();
  if (kept_.empty()) return reports_;
  try_again();
  ask();
  const auto braked = [](const auto& kept) { return kept.second.is_braked; };
  for (const auto& [step, kept] : kept_) {
    if (kept.is_braked) reports_.push_back(stopped(step, kept));
  }
  std::erase_if(kept_, braked);
  std::ranges::stable_sort(reports_, {}, &MotionReport::step);
  return reports_;
}

std::vector<StepId> AuthorityGate::refused_for_long() {
  std::vector<StepId> steps;
  for (auto& [step, kept] : kept_) {
    if (!kept.is_reported || kept.is_braked || now_ - kept.since < kMissing) continue;
    if (!std::exchange(kept.is_for_long, true)) steps.push_back(step);
  }
  return steps;
}

// Tells the guard where moving arms are, and in each cycle where one of the arms at rest is. The
// position of an arm whose controller has not connected yet is not known.
void AuthorityGate::see_positions() {
  looked_at_ = (looked_at_ + 1) % static_cast<std::uint32_t>(steps_.size());
  for (std::uint32_t a = 0; a < steps_.size(); ++a) {
    const ArmId arm{a};
    const ArmPosition& position = guard_.position(arm);
    if (motions_.link(arm).state() == ArmLink::State::connecting) continue;
    if (position.at_rest && position.is_known && a != looked_at_) continue;
    const ArmFeedback& feedback = motions_.feedback(arm);
    if (is_at_rest(feedback.phase)) {
      guard_.rests(arm, feedback.measured_progress, motions_.measured());
    } else {
      guard_.moves(arm, feedback.measured_progress);
      guard_.acknowledges(arm, feedback.authority);
    }
  }
}

void AuthorityGate::try_again() {
  for (auto kept = kept_.begin(); kept != kept_.end();) {
    auto& [step, what] = *kept;
    if (what.is_braked) {
      ++kept;
      continue;
    }
    const auto refusal = passes(what.motion, what.from(), what.authority);
    if (refusal) {
      what.refusal = *refusal;
      const bool may_come = now_ - what.since < kMissing || what.answers < kAnswers;
      if (refusal->why != Why::uncertified || !may_come) report(step, what);
      ++kept;
      continue;
    }
    if (what.start) {
      what.start->authority = what.authority;
      motions_.dispatch(*what.start, what.motion);
    } else {
      motions_.grant({step, what.authority});
    }
    const StepId passed = step;
    const bool was_reported = what.is_reported;
    kept = kept_.erase(kept);
    if (was_reported) calls_.allowed(passed);
  }
}

// Asks for missing certificates, one step after the other, with all other arms where they are.
void AuthorityGate::ask() {
  if (asked_) return;
  auto next = kept_.end();
  for (auto kept = kept_.begin(); kept != kept_.end(); ++kept) {
    const Kept& what = kept->second;
    if (what.refusal.why != Why::uncertified || what.is_braked || now_ < what.asks_from) continue;
    if (next == kept_.end() || what.asks_from < next->second.asks_from) next = kept;
  }
  if (next == kept_.end()) return;
  next->second.asks_from = now_ + kAskAgain;
  asked_ = next->first;
  calls_.certify(question_about(next->first, next->second));
}

Question AuthorityGate::question_about(StepId step, const Kept& kept) const {
  Question question{.version = 0,
                    .start_at = now_,
                    .candidates = {},
                    .others = {},
                    .rest = guard_.rest(),
                    .method = Coordinated{TrackingErrors(*cell_)}};
  std::map<StepId, Motion> others;
  for (std::uint32_t a = 0; a < steps_.size(); ++a) {
    const ArmPosition& position = guard_.position(ArmId{a});
    const bool is_own =
        std::ranges::find(kept.motion->arms(), ArmId{a}) != kept.motion->arms().end();
    if (is_own || position.at_rest || !steps_[a]) continue;
    Motion& other =
        others.try_emplace(*steps_[a], Motion{*steps_[a], position.motion, position.measured})
            .first->second;
    other.progress = std::min(other.progress, position.measured);
    const double error = cell_->tracking_error(cell_->arm(ArmId{a}).robot);
    other.off_path = std::max(other.off_path, certified_error(position.error(), error));
  }
  for (const auto& [id, other] : others) question.others.push_back(other);
  double error = 0.0;
  for (const ArmId arm : kept.motion->arms()) {
    error = std::max(error, cell_->tracking_error(cell_->arm(arm).robot));
  }
  const double off_path = guard_.off_path(kept.motion, kept.from());
  question.candidates = {Motion{.step = step,
                                .trajectory = kept.motion,
                                .progress = stopped(step, kept).progress,
                                .off_path = certified_error(off_path, error)}};
  if (kept.answers > 0) question.effort = kEffortGrowth;
  return question;
}

// Returns the report of a motion that was braked before its arms got it.
MotionReport AuthorityGate::stopped(StepId step, const Kept& kept) const {
  Duration last = kept.motion->duration(), farthest{};
  for (const ArmId arm : kept.motion->arms()) {
    const ArmPosition& position = guard_.position(arm);
    const Duration at = position.motion == kept.motion || !kept.start ? position.measured
                                                                      : kept.start->from_progress;
    last = std::min(last, at);
    farthest = std::max(farthest, at);
  }
  return {step, MotionReport::Kind::stopped,
          last, joints_of(motions_.measured(), kept.motion->joints()),
          "",   farthest};
}

std::optional<GuardRefusal> AuthorityGate::refusal(StepId step) const {
  const auto kept = kept_.find(step);
  const bool is_reported = kept != kept_.end() && kept->second.is_reported;
  return is_reported ? std::optional(kept->second.refusal) : std::nullopt;
}

}  // namespace armloom
