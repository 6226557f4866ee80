#include "core/jobs/pace.h"

#include "core/model/promises.h"

namespace armloom {
namespace {

constexpr double kHardlySlow = 1.1;

Promises promises_for(const Cell& cell, const Job& job) {
  return promises_of(cell, job.trajectory->arms());
}

}  // namespace

std::optional<TimePoint> stands_since(const Job& job) {
  if (const auto* moving = job.in<Moving>()) {
    return moving->pause ? std::nullopt : std::optional(moving->moved_at);
  }
  const bool stopped = job.in<Braking>() != nullptr || job.in<Held>() != nullptr;
  return stopped ? std::optional(job.times.measured_at) : std::nullopt;
}

bool is_standing(const Cell& cell, const Job& job, TimePoint now) {
  const auto* moving = job.in<Moving>();
  return moving != nullptr && now - moving->moved_at >= promises_for(cell, job).stands_from();
}

Duration stood_for(const Cell& cell, const Job& job, TimePoint now) {
  const auto since = stands_since(job);
  if (!since) return Duration{};
  const Duration stood = now - *since;
  return stood < promises_for(cell, job).stands_from() ? Duration{} : stood;
}

double pace_of(const Cell& cell, const Job& job, double planned, TimePoint now) {
  const auto* moving = job.in<Moving>();
  if (moving == nullptr || moving->pause || is_standing(cell, job, now)) return planned;
  const Duration way = job.progress - moving->goes_from;
  if (way < promises_for(cell, job).pace_from()) return planned;
  const double pace = to_seconds(moving->moved_at - moving->goes_since) / to_seconds(way);
  return pace < kHardlySlow * planned ? planned : pace;
}

}  // namespace armloom
