#include "server/codec/wall_clock.h"

#include <algorithm>
#include <cstdio>
#include <ctime>

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
  constexpr double kLongAgo_s = 9e8;
  const std::chrono::duration<double> since = wall - anchors_.front().wall;
  const double cell_s = since.count() * anchors_.front().speed;
  return std::min(anchors_.front().time, TimePoint{}) +
         from_seconds(std::clamp(cell_s, -kLongAgo_s, 0.0));
}

std::string WallClock::at(TimePoint time) const {
  using std::chrono::milliseconds;
  const auto total_ms = std::chrono::floor<milliseconds>(wall_at(time)).time_since_epoch().count();
  const std::time_t seconds = static_cast<std::time_t>(total_ms / 1000);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char date[32];
  char text[48];
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(text, sizeof text, "%s.%03dZ", date, static_cast<int>(total_ms % 1000));
  return text;
}

}  // namespace armloom
