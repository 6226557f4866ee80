#include "server/codec/wall_clock.h"

#include <algorithm>

#include "server/codec/rfc3339.h"

namespace armloom {

void WallClock::anchor(TimePoint time, Wall wall, double speed) {
  anchors_.push_back({time, wall, speed});
  if (anchors_.size() > kAnchorsMax) anchors_.pop_front();
}

void WallClock::observe(TimePoint time, Wall wall) {
  const auto off = std::chrono::abs(wall - wall_at(time));
  if (off > kSlip) anchor(time, wall, anchors_.back().speed);
}

WallClock::Wall WallClock::wall_at(TimePoint time) const {
  auto anchor = anchors_.rbegin();
  while (anchor->time > time && std::next(anchor) != anchors_.rend()) ++anchor;
  const std::chrono::duration<double> since(to_seconds(time - anchor->time) / anchor->speed);
  return anchor->wall + std::chrono::duration_cast<Wall::duration>(since);
}

TimePoint WallClock::time_before(Wall wall) const {
  return std::min(time_at(wall), std::min(anchors_.front().time, TimePoint{}));
}

TimePoint WallClock::time_at(Wall wall) const {
  constexpr double kLong_s = 9e8;
  const std::chrono::duration<double> since = wall - anchors_.front().wall;
  const double cell_s = since.count() * anchors_.front().speed;
  return anchors_.front().time + from_seconds(std::clamp(cell_s, -kLong_s, kLong_s));
}

std::string WallClock::at(TimePoint time) const { return rfc3339(since_1970_ms(wall_at(time))); }

}  // namespace armloom
