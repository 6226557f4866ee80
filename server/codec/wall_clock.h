#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "core/base/time.h"

namespace armloom {

[[nodiscard]] inline std::int64_t since_1970_ms(std::chrono::system_clock::time_point wall) {
  return std::chrono::floor<std::chrono::milliseconds>(wall).time_since_epoch().count();
}

// Converts cell time to wall time by anchors. At an anchor, cell time and wall time are both known;
// from there on, cell time runs `speed` times as fast as wall time. A new anchor does not change
// earlier times. Used on the server's thread.
class WallClock {
 public:
  using Wall = std::chrono::system_clock::time_point;
  inline static constexpr std::size_t kAnchorsMax = 256;  // older anchors are dropped
  // If cell time deviates from wall time by more than this, it has slipped, because the machine was
  // busy.
  inline static constexpr std::chrono::milliseconds kSlip{100};

  WallClock(Wall start, double speed) : anchors_{{TimePoint{}, start, speed}} {}

  // Sets an anchor: cell time `time` is wall time `wall`, and runs at `speed` > 0 from there on.
  // The times of successive anchors must not decrease.
  void anchor(TimePoint time, Wall wall, double speed);
  // Sets a new anchor if cell time has slipped.
  void observe(TimePoint time, Wall wall);

  [[nodiscard]] Wall wall_at(TimePoint time) const;
  // Returns the cell time of a wall time before the session. It is negative, or zero if the wall
  // clock was set back.
  [[nodiscard]] TimePoint time_before(Wall wall) const;
  // Returns the cell time of a wall time, before or after the session's start, if the speed stays
  // as it was at the start.
  [[nodiscard]] TimePoint time_at(Wall wall) const;
  // Returns the present speed: cell seconds per wall second.
  [[nodiscard]] double speed() const { return anchors_.back().speed; }
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
