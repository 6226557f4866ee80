#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "core/base/time.h"

namespace armloom {

// Returns whole milliseconds since 1970, as stored.
[[nodiscard]] inline std::int64_t since_1970_ms(std::chrono::system_clock::time_point wall) {
  return std::chrono::floor<std::chrono::milliseconds>(wall).time_since_epoch().count();
}

// Converts cell time to wall time by anchors: at an anchor both times are known, and from there
// cell time runs `speed` times as fast as the wall. A new anchor does not affect earlier times, so
// a reported instant keeps its wall time. Not thread-safe; used on the server's thread.
class WallClock {
 public:
  using Wall = std::chrono::system_clock::time_point;
  inline static constexpr std::size_t kAnchorsMax = 256;  // older anchors are dropped
  // A larger deviation of cell time from the wall is a slip (a busy machine).
  inline static constexpr std::chrono::milliseconds kSlip{100};

  WallClock(Wall start, double speed) : anchors_{{TimePoint{}, start, speed}} {}

  // Sets an anchor: cell time `time` is `wall`, and cell time runs at `speed` > 0 from there. Times
  // must not decrease from call to call.
  void anchor(TimePoint time, Wall wall, double speed);
  // Takes the observation of `time` at `wall`; corrects a slip with a new anchor.
  void observe(TimePoint time, Wall wall);

  [[nodiscard]] Wall wall_at(TimePoint time) const;
  // Returns the cell time of a wall time before the session: less than zero, or zero if the wall
  // clock was set back since.
  [[nodiscard]] TimePoint time_before(Wall wall) const;
  // Returns the present speed: cell seconds per wall second.
  [[nodiscard]] double speed() const { return anchors_.back().speed; }
  // Returns the wall time as RFC 3339.
  [[nodiscard]] std::string at(TimePoint time) const;

 private:
  struct Anchor {
    TimePoint time;
    Wall wall;
    double speed;
  };
  std::deque<Anchor> anchors_;  // never empty, times ascending
};

}  // namespace armloom
