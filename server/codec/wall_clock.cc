#include "server/codec/wall_clock.h"

#include <cstdio>
#include <ctime>

namespace armloom {

std::string WallClock::at(TimePoint time) const {
  using std::chrono::milliseconds;
  const std::chrono::duration<double> since_start(to_seconds(time) / speed_);
  const auto wall = start_ + std::chrono::duration_cast<std::chrono::nanoseconds>(since_start);
  const auto total_ms = std::chrono::floor<milliseconds>(wall).time_since_epoch().count();
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
