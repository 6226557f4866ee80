#pragma once

#include <chrono>
#include <string>

#include "core/base/time.h"

namespace armloom {

// Turns cell time into wall time: cell time zero was at `start`, and cell time runs `speed` times
// as fast as the wall.
class WallClock {
 public:
  WallClock(std::chrono::system_clock::time_point start, double speed)
      : start_(start), speed_(speed) {}

  // RFC 3339 in UTC with milliseconds: "2026-11-21T09:33:00.125Z".
  [[nodiscard]] std::string at(TimePoint time) const;

 private:
  std::chrono::system_clock::time_point start_;
  double speed_;
};

}  // namespace armloom
