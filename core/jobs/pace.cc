#include "core/jobs/pace.h"

#include "core/model/promises.h"

namespace armloom {
namespace {

constexpr double kHardlySlow = 1.1;

Promises promises_for(const Cell& cell, const Step& step) {
  return promises_of(cell, step.trajectory->arms());
}

}  // namespace

std::optional<TimePoint> stands_since(const Step& step) {
  if (const auto* moving = step.in<Moving>()) {
    return moving->pause ? std::nullopt : std::optional(moving->moved_at);
  }
  const bool stopped = step.in<Braking>() != nullptr || step.in<Held>() != nullptr;
  return stopped ? std::optional(step.times.measured_at) : std::nullopt;
}

bool is_standing(const Cell& cell, const Step& step, TimePoint now) {
  const auto* moving = step.in<Moving>();
  return moving != nullptr && now - moving->moved_at >= promises_for(cell, step).stands_from();
}

Duration stood_for(const Cell& cell, const Step& step, TimePoint now) {
  const auto since = stands_since(step);
  if (!since) return Duration{};
  const Duration stood = now - *since;
  return stood < promises_for(cell, step).stands_from() ? Duration{} : stood;
}

double pace_of(const Cell& cell, const Step& step, double planned, TimePoint now) {
  const auto* moving = step.in<Moving>();
  if (moving == nullptr || moving->pause || is_standing(cell, step, now)) return planned;
  const Duration way = step.progress - moving->goes_from;
  if (way < promises_for(cell, step).pace_from()) return planned;
  const double pace = to_seconds(moving->moved_at - moving->goes_since) / to_seconds(way);
  return pace < kHardlySlow * planned ? planned : pace;
}

}  // namespace armloom
