#include "core/jobs/pace.h"

namespace armloom {
namespace {

// The pace of a motion is told from so much of its way, and counts from there on.
constexpr Duration kPaceFrom = std::chrono::milliseconds(100);
constexpr double kHardlySlow = 1.1;

}  // namespace

std::optional<TimePoint> stands_since(const Job& job) {
  if (const auto* moving = job.in<Moving>()) {
    return moving->pause ? std::nullopt : std::optional(moving->moved_at);
  }
  const bool stopped = job.in<Braking>() != nullptr || job.in<Held>() != nullptr;
  return stopped ? std::optional(job.times.measured_at) : std::nullopt;
}

bool is_standing(const Moving& moving, TimePoint now) {
  return now - moving.moved_at >= kStandsFrom;
}

Duration stood_for(const Job& job, TimePoint now) {
  const auto since = stands_since(job);
  const Duration stood = since ? now - *since : Duration{};
  return stood < kStandsFrom ? Duration{} : stood;
}

double pace_of(const Job& job, double planned, TimePoint now) {
  const auto* moving = job.in<Moving>();
  if (moving == nullptr || moving->pause || is_standing(*moving, now)) return planned;
  const Duration way = job.progress - moving->goes_from;
  if (way < kPaceFrom) return planned;
  const double pace = to_seconds(moving->moved_at - moving->goes_since) / to_seconds(way);
  return pace < kHardlySlow * planned ? planned : pace;
}

}  // namespace armloom
