#include "core/arm/faulty_link.h"

#include <algorithm>
#include <utility>

namespace armloom {
namespace {

constexpr std::uint64_t kSeedOfLink = 0xd1b54a32d192ed03;

}  // namespace

FaultyLink::FaultyLink(std::unique_ptr<FaultyArm> arm, std::uint64_t seed)
    : arm_(std::move(arm)), random_(seed ^ kSeedOfLink) {}

void FaultyLink::inject(std::uint64_t id, ArmFault fault) {
  if (is_of_link(fault.kind)) return faults_.add(id, fault);
  arm_->inject(id, fault);
}

bool FaultyLink::remove(std::uint64_t id) { return faults_.remove(id) || arm_->remove(id); }

std::map<std::uint64_t, ArmFault> FaultyLink::faults() const {
  auto all = arm_->faults();
  all.insert(faults_.all().begin(), faults_.all().end());
  return all;
}

// In [0, 1). The same on every platform, unlike std::uniform_real_distribution.
double FaultyLink::uniform() { return static_cast<double>(random_() >> 11U) * 0x1.0p-53; }

bool FaultyLink::chance(Kind kind) {
  const ArmFault* fault = active(kind);
  return fault != nullptr && uniform() < fault->value;
}

bool FaultyLink::is_plain() const {
  return faults_.empty() && connection_.is_up && commands_.messages.empty() &&
         reports_.messages.empty() && clock_ahead_ == Duration{} && before_restart_ == 0;
}

template <class Message>
void FaultyLink::put(Way<Message>& way, const Message& message) {
  if (chance(Kind::loss)) return;
  TimePoint arrives = now_;
  if (const ArmFault* delay = active(Kind::delay)) arrives += from_seconds(delay->value);
  if (const ArmFault* jitter = active(Kind::jitter)) {
    arrives += from_seconds(jitter->value * uniform());
  }
  arrives = std::max(arrives, way.last);
  if (chance(Kind::reorder)) {
    arrives += kOvertaken;
  } else {
    way.last = arrives;
  }
  const auto place =
      std::ranges::upper_bound(way.messages, arrives, {}, &Way<Message>::UnderWay::arrives);
  way.messages.insert(place, {arrives, message});
}

void FaultyLink::send(const ArmCommand& command) {
  if (is_plain()) return arm_->send(command);
  if (!connection_.is_up) return;
  put(commands_, command);
  deliver_commands();
}

void FaultyLink::deliver_commands() {
  while (!commands_.messages.empty() && commands_.messages.front().arrives <= now_) {
    arm_->send(commands_.messages.front().message);
    commands_.messages.pop_front();
  }
}

const ArmFeedback* FaultyLink::poll(TimePoint now) {
  const Duration period = now - std::exchange(now_, now);
  if (is_plain()) {
    const ArmFeedback* report = arm_->poll(now);
    if (report != nullptr) last_sequence_ = report->sequence;
    return report;
  }
  if (period > Duration{}) {
    if (const ArmFault* drift = active(Kind::clock_drift)) {
      clock_ahead_ += from_seconds(drift->value * to_seconds(period));
    }
    deliver_commands();
    take_reports();
  }
  if (reports_.messages.empty() || reports_.messages.front().arrives > now_) return nullptr;
  delivered_ = std::move(reports_.messages.front().message);
  reports_.messages.pop_front();
  const bool changes = faults_.any([&](const ArmFault& fault) {
    return fault.kind != Kind::clock_drift && !fault.is_over(now_);
  });
  if (changes || !commands_.messages.empty()) delivered_.settled = false;
  return &delivered_;
}

// Reports of a cycle in which the connection comes back belong to neither connection.
void FaultyLink::take_reports() {
  const bool was_up = connection_.is_up;
  while (const ArmFeedback* report = arm_->poll(now_)) {
    last_sequence_ = report->sequence;
    if (!was_up) continue;
    ArmFeedback stamped = *report;
    stamped.sequence -= before_restart_;
    stamped.controller_time += clock_ahead_;
    put(reports_, stamped);
  }
  connect_or_cut();
}

void FaultyLink::connect_or_cut() {
  const bool restarts = active(Kind::restart) != nullptr;
  const bool is_down = restarts || active(Kind::cut) != nullptr;
  restarting_ = restarting_ || restarts;
  if (is_down && connection_.is_up) {
    connection_.is_up = false;
    connection_.detail =
        restarts ? "the simulated controller restarts" : "the simulated connection is cut";
    commands_ = {};
    reports_ = {};
    arm_->lose_connection();
  }
  if (is_down || connection_.is_up) return;
  if (restarting_) {
    if (!arm_->restart()) return;
    restarting_ = false;
    before_restart_ = last_sequence_;
    clock_ahead_ = -now_.time_since_epoch();
  }
  connection_.is_up = true;
  connection_.detail.clear();
  ++connection_.number;
}

}  // namespace armloom
