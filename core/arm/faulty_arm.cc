#include "core/arm/faulty_arm.h"

#include <algorithm>
#include <utility>

namespace armloom {

using Phase = ArmFeedback::Phase;

FaultyArm::FaultyArm(std::unique_ptr<ArmController> inner) : inner_(std::move(inner)) {
  feedback_ = inner_->tick(now_);
}

void FaultyArm::inject(std::uint64_t id, ArmFault fault) { faults_.insert_or_assign(id, fault); }

bool FaultyArm::remove(std::uint64_t id) { return faults_.erase(id) > 0; }

const ArmFault* FaultyArm::active(ArmFault::Kind kind) const {
  for (const auto& [id, fault] : faults_) {
    const bool begun = fault.from <= now_;
    const bool over = fault.until && *fault.until <= now_;
    if (fault.kind == kind && begun && !over) return &fault;
  }
  return nullptr;
}

void FaultyArm::start(TrajectoryPtr trajectory, TimePoint start_at, Duration from_progress,
                      Duration authority) {
  if (const ArmFault* late = active(ArmFault::Kind::late_start)) {
    start_at += from_seconds(late->value);
  }
  granted_ = allowed_ = authority;
  creep_s_.reset();
  inner_->start(std::move(trajectory), start_at, from_progress, authority);
  under_way_ = true;
  told_.phase = Phase::waiting;
  told_.commanded_progress = told_.measured_progress = from_progress;
}

void FaultyArm::grant(Duration authority) {
  granted_ = authority;
  // Authority that a fault withholds stays withheld; the next tick decides.
  if (allowed_ > granted_ || (!active(ArmFault::Kind::stall) && !active(ArmFault::Kind::slow))) {
    allowed_ = granted_;
    inner_->grant(allowed_);
  }
}

void FaultyArm::brake() { inner_->brake(); }

void FaultyArm::release() {
  inner_->release();
  under_way_ = false;
  giving_up_ = false;
  phase_ = told_.phase = Phase::idle;
}

const ArmFeedback& FaultyArm::tick(TimePoint now) {
  const ArmFeedback& feedback = advance(now);
  const bool drops = active(ArmFault::Kind::drop_feedback) != nullptr;
  if (drops && !dropping_) told_ = feedback;
  dropping_ = drops;
  if (!drops) return feedback;
  told_.settled = false;
  return told_;
}

const ArmFeedback& FaultyArm::advance(TimePoint now) {
  const Duration period = now - std::exchange(now_, now);
  const bool sound = faults_.empty() && !giving_up_ && allowed_ == granted_;
  if (sound) {
    const ArmFeedback& feedback = inner_->tick(now);
    phase_ = feedback.phase;
    feedback_.commanded_progress = feedback.commanded_progress;
    return feedback;
  }
  if (under_way_) {
    const bool moves = phase_ == Phase::moving || phase_ == Phase::braking;
    if (moves && active(ArmFault::Kind::fault)) give_up();
    withhold(period);
  }
  feedback_ = inner_->tick(now);
  // An arm whose path is commanded to the end cannot brake any more: it gives up at the goal.
  if (giving_up_ && (feedback_.phase == Phase::stopped || feedback_.phase == Phase::finished)) {
    feedback_.phase = Phase::fault;
    feedback_.detail = "the simulated controller gave up";
  }
  phase_ = feedback_.phase;
  if (under_way_ && fault_changes()) feedback_.settled = false;
  return feedback_;
}

// Returns true if the faults' effect on the present motion changes with time.
bool FaultyArm::fault_changes() const {
  const bool over = phase_ == Phase::stopped || phase_ == Phase::finished || phase_ == Phase::fault;
  if (over) return false;
  return (allowed_ != granted_ && active(ArmFault::Kind::slow) != nullptr) ||
         std::ranges::any_of(faults_, [this](const auto& entry) {
           const ArmFault& fault = entry.second;
           return fault.from > now_ || (fault.until && *fault.until > now_);
         });
}

void FaultyArm::give_up() {
  giving_up_ = true;
  inner_->brake();
  std::erase_if(faults_, [this](const auto& entry) {
    return entry.second.kind == ArmFault::Kind::fault && entry.second.from <= now_;
  });
}

void FaultyArm::withhold(Duration period) {
  const Duration at = feedback_.commanded_progress;
  Duration allowed = granted_;
  if (active(ArmFault::Kind::stall)) allowed = std::min(allowed, at);
  if (const ArmFault* slow = active(ArmFault::Kind::slow)) {
    if (!creep_s_) creep_s_ = to_seconds(at);
    *creep_s_ += to_seconds(period) * std::clamp(slow->value, 0.0, 1.0);
    allowed = std::min(allowed, from_seconds(*creep_s_));
  } else {
    creep_s_.reset();
  }
  if (allowed == allowed_) return;
  allowed_ = allowed;
  inner_->grant(allowed_);
}

}  // namespace armloom
