#include "core/arm/faulty_arm.h"

#include <algorithm>
#include <utility>

namespace armloom {

FaultyArm::FaultyArm(std::unique_ptr<ArmController> inner, Push push)
    : inner_(std::move(inner)), push_(std::move(push)) {}

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

// ---- Commands ----

void FaultyArm::send(const ArmCommand& command) {
  if (command.number != acknowledged_ + 1) return;
  acknowledged_ = command.number;
  std::visit([this](const auto& what) { carry_out(what); }, command.what);
}

void FaultyArm::carry_out(const ArmCommand::Follow& follow) {
  ArmCommand::Follow passed = follow;
  if (const ArmFault* late = active(ArmFault::Kind::late_start)) {
    passed.start_at += from_seconds(late->value);
  }
  granted_ = allowed_ = follow.authority;
  creep_s_.reset();
  under_way_ = true;
  is_braked_ = false;
  pass_on(passed);
  follow_ = {acknowledged_, inner_number_};
}

void FaultyArm::carry_out(const ArmCommand::Extend& extend) {
  granted_ = extend.authority;
  // Authority that a fault withholds stays withheld; the next cycle decides.
  if (allowed_ > granted_ || (!active(ArmFault::Kind::stall) && !active(ArmFault::Kind::slow))) {
    allowed_ = granted_;
    pass_on(ArmCommand::Extend{allowed_});
  }
}

void FaultyArm::carry_out(const ArmCommand::Release& release) {
  pass_on(release);
  under_way_ = false;
  giving_up_ = false;
}

void FaultyArm::carry_out(const ArmCommand::Brake& brake) {
  is_braked_ = true;
  pass_on(brake);
}

// ---- Each control cycle ----

const ArmFeedback* FaultyArm::poll(TimePoint now) {
  if (now != now_) act(now - std::exchange(now_, now));
  const ArmFeedback* inner = inner_->poll(now);
  if (inner == nullptr) return nullptr;
  report(*inner);
  return active(ArmFault::Kind::drop_feedback) == nullptr ? &feedback_ : nullptr;
}

void FaultyArm::act(Duration period) {
  const ArmFault* drift = active(ArmFault::Kind::drift);
  if (drift != nullptr && may_drift()) push_(drift->value * to_seconds(period));
  const bool sound = faults_.empty() && !giving_up_ && allowed_ == granted_;
  if (sound || !under_way_) return;
  const bool moves = feedback_.phase == Phase::moving || feedback_.phase == Phase::braking;
  if (moves && active(ArmFault::Kind::fault)) give_up();
  withhold(period);
}

void FaultyArm::report(const ArmFeedback& inner) {
  feedback_ = inner;
  feedback_.acknowledged = acknowledged_;
  feedback_.authority = under_way_ ? std::max(granted_, inner.authority) : inner.authority;
  feedback_.rejected = inner.rejected == follow_.second ? follow_.first : 0;
  // An arm whose path is commanded to the end cannot brake any more: it gives up at the goal.
  if (giving_up_ && (inner.phase == Phase::stopped || inner.phase == Phase::finished)) {
    feedback_.phase = Phase::fault;
    feedback_.detail = "the simulated controller gave up";
  }
  if ((under_way_ && fault_changes()) || may_drift()) feedback_.settled = false;
  if (may_drift() && active(ArmFault::Kind::drift) != nullptr) feedback_.at_rest = false;
}

// Returns true if the arm drifts now or later without a further command.
bool FaultyArm::may_drift() const {
  return push_ && !is_braked_ && std::ranges::any_of(faults_, [this](const auto& entry) {
           const ArmFault& fault = entry.second;
           return fault.kind == ArmFault::Kind::drift && !(fault.until && *fault.until <= now_);
         });
}

// Returns true if the faults' effect on the present motion changes with time.
bool FaultyArm::fault_changes() const {
  const Phase phase = feedback_.phase;
  const bool over = phase == Phase::stopped || phase == Phase::finished || phase == Phase::fault;
  if (over) return false;
  return (allowed_ != granted_ && active(ArmFault::Kind::slow) != nullptr) ||
         std::ranges::any_of(faults_, [this](const auto& entry) {
           const ArmFault& fault = entry.second;
           return fault.from > now_ || (fault.until && *fault.until > now_);
         });
}

void FaultyArm::give_up() {
  giving_up_ = is_braked_ = true;
  pass_on(ArmCommand::Brake{});
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
  pass_on(ArmCommand::Extend{allowed_});
}

}  // namespace armloom
