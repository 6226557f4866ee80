#include "core/arm/faulty_arm.h"

#include <algorithm>
#include <utility>

namespace armloom {
namespace {

// The noise of a fault must not repeat the arm's own, which has the same seed.
constexpr std::uint64_t kOtherSeed = 0x9e3779b97f4a7c15;

}  // namespace

FaultyArm::FaultyArm(std::unique_ptr<SimulatedArm> inner, std::uint64_t seed)
    : inner_(std::move(inner)), noise_(seed ^ kOtherSeed) {}

void FaultyArm::inject(std::uint64_t id, ArmFault fault) { faults_.add(id, fault); }

bool FaultyArm::remove(std::uint64_t id) { return faults_.remove(id); }

// ---- Commands ----

void FaultyArm::send(const ArmCommand& command) {
  if (command.number != acknowledged_ + 1) return;
  acknowledged_ = command.number;
  std::visit([this](const auto& what) { carry_out(what); }, command.what);
}

void FaultyArm::carry_out(const ArmCommand::Follow& follow) {
  motion_ = {.under_way = true, .granted = follow.authority, .allowed = follow.authority};
  if (follow.trajectory) motion_.end = follow.trajectory->duration();
  if (active(Kind::reject)) {
    faults_.use_up(Kind::reject, now_);
    motion_ = {.follow = {acknowledged_, 0}, .rejected = true};
    return;
  }
  ArmCommand::Follow passed = follow;
  if (const ArmFault* late = active(Kind::late_start)) {
    passed.start_at += from_seconds(late->value);
  }
  pass_on(passed);
  motion_.follow = {acknowledged_, inner_number_};
}

void FaultyArm::carry_out(const ArmCommand::Extend& extend) {
  motion_.granted = extend.authority;
  // Authority that a fault withholds or exceeds is decided in the next cycle.
  if (active(Kind::stall) || active(Kind::slow) || active(Kind::runaway)) {
    if (motion_.ran_away || motion_.allowed <= motion_.granted) return;
  }
  motion_.allowed = motion_.granted;
  pass_on(ArmCommand::Extend{motion_.allowed});
}

void FaultyArm::carry_out(const ArmCommand::Brake& brake) {
  if (active(Kind::ignore_stop) && brake.category != StopCategory::switch_off) {
    motion_.ignored = brake;
    return;
  }
  motion_.ignored.reset();
  motion_.braked = true;
  pass_on(brake);
}

void FaultyArm::carry_out(const ArmCommand::Release& release) {
  pass_on(release);
  forget_motion();
}

// A brake still holds the arm.
void FaultyArm::forget_motion() { motion_ = {.braked = motion_.braked}; }

void FaultyArm::lose_connection() {
  if (motion_.under_way) carry_out(ArmCommand::Brake{});
}

bool FaultyArm::restart() {
  const bool in_motion = feedback_.phase == Phase::waiting || feedback_.phase == Phase::moving ||
                         feedback_.phase == Phase::braking;
  if (in_motion) return false;
  pass_on(ArmCommand::Release{});
  forget_motion();
  acknowledged_ = 0;
  frozen_.reset();
  return true;
}

// ---- Each control cycle ----

const ArmFeedback* FaultyArm::poll(TimePoint now) {
  if (now != now_) act(now - std::exchange(now_, now));
  const ArmFeedback* inner = inner_->poll(now);
  if (inner == nullptr) return nullptr;
  if (!active(Kind::freeze_feedback)) {
    frozen_.reset();
  } else if (!frozen_) {
    frozen_ = feedback_.sequence > 0 ? feedback_ : *inner;
  }
  report(*inner);
  if (active(Kind::drop_feedback)) return nullptr;
  if (!frozen_) return &feedback_;
  frozen_->sequence = inner->sequence;
  frozen_->controller_time = inner->controller_time;
  return &*frozen_;
}

void FaultyArm::act(Duration period) {
  if (motion_.ignored && !active(Kind::ignore_stop)) carry_out(ArmCommand::Brake(*motion_.ignored));
  const ArmFault* drift = motion_.braked ? nullptr : active(Kind::drift);
  if (drift != nullptr) inner_->push(0, drift->value * to_seconds(period));
  const bool sound = faults_.empty() && !motion_.giving_up && motion_.allowed == motion_.granted;
  if (sound || !motion_.under_way) return;
  const bool moves = feedback_.phase == Phase::moving || feedback_.phase == Phase::braking;
  if (moves && active(Kind::fault)) give_up();
  limit(period);
}

void FaultyArm::give_up() {
  motion_.giving_up = true;
  carry_out(ArmCommand::Brake{});
  faults_.use_up(Kind::fault, now_);
}

// Sets the authority of the inner controller, which faults make smaller or larger than the
// caller's.
void FaultyArm::limit(Duration period) {
  const Duration at = feedback_.commanded_progress;
  Duration allowed = motion_.granted;
  if (active(Kind::runaway)) {
    allowed = motion_.end;
    motion_.ran_away = true;
  }
  if (active(Kind::stall)) allowed = std::min(allowed, at);
  if (const ArmFault* slow = active(Kind::slow)) {
    if (!motion_.creep_s) motion_.creep_s = to_seconds(at);
    *motion_.creep_s += to_seconds(period) * std::clamp(slow->value, 0.0, 1.0);
    allowed = std::min(allowed, from_seconds(*motion_.creep_s));
  } else {
    motion_.creep_s.reset();
  }
  if (allowed == motion_.allowed) return;
  motion_.allowed = allowed;
  pass_on(ArmCommand::Extend{allowed});
}

void FaultyArm::report(const ArmFeedback& inner) {
  feedback_ = inner;
  feedback_.acknowledged = acknowledged_;
  feedback_.rejected = inner.rejected == motion_.follow.second ? motion_.follow.first : 0;
  if (motion_.under_way) {
    // The inner controller raises an authority that is too close for a brake.
    const Duration raised = motion_.ran_away ? Duration{} : inner.authority;
    feedback_.authority = std::max(motion_.granted, raised);
  }
  if (motion_.rejected) {
    feedback_.rejected = motion_.follow.first;
    feedback_.phase = Phase::fault;
    feedback_.detail = "the simulated controller rejected the motion";
  }
  // An arm whose path is commanded to the end cannot brake any more: it gives up at the goal.
  if (motion_.giving_up && (inner.phase == Phase::stopped || inner.phase == Phase::finished)) {
    feedback_.phase = Phase::fault;
    feedback_.detail = "the simulated controller gave up";
  }
  if (const ArmFault* noise = active(Kind::noise)) {
    for (double& position : feedback_.measured) position += noise->value * noise_.next();
  }
  if (faults_.empty()) return;
  if (!motion_.braked && active(Kind::drift)) feedback_.at_rest = false;
  if (report_changes()) feedback_.settled = false;
}

// Returns true if faults change the reports with time, without a command.
bool FaultyArm::report_changes() const {
  const Phase phase = feedback_.phase;
  const bool over = phase == Phase::stopped || phase == Phase::finished || phase == Phase::fault;
  const bool follows = motion_.under_way && !over;
  if (follows && motion_.allowed != motion_.granted && active(Kind::slow)) return true;
  return faults_.any([&](const ArmFault& fault) {
    if (fault.is_over(now_)) return false;
    const bool at_rest = fault.kind == Kind::drop_feedback || fault.kind == Kind::noise ||
                         (fault.kind == Kind::drift && !motion_.braked);
    return at_rest || (follows && (fault.from > now_ || fault.until));
  });
}

}  // namespace armloom
