#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>

#include "core/base/time.h"

namespace armloom {

// Whole milliseconds since 1970, as they are stored.
[[nodiscard]] inline std::int64_t since_1970_ms(std::chrono::system_clock::time_point wall) {
  return std::chrono::floor<std::chrono::milliseconds>(wall).time_since_epoch().count();
}

// Turns cell time into wall time by anchors: at each, both times are known, and from there cell
// time runs `speed` times as fast as the wall. A new anchor says nothing about the time before it:
// an instant that was told once keeps its wall time. Not thread-safe: the server's thread.
class WallClock {
 public:
  using Wall = std::chrono::system_clock::time_point;
  inline static constexpr std::size_t kAnchorsMax = 256;  // the oldest ones are given up
  // Cell time that is farther from the wall's than this has slipped (a busy machine).
  inline static constexpr std::chrono::milliseconds kSlip{100};

  WallClock(Wall start, double speed) : anchors_{{TimePoint{}, start, speed}} {}

  // From cell time `time` on, which is `wall`, cell time runs at `speed` > 0. `time` does not go
  // backwards from call to call.
  void anchor(TimePoint time, Wall wall, double speed);
  // `time` was observed at `wall`: a slip is made up for.
  void observe(TimePoint time, Wall wall);

  [[nodiscard]] Wall wall_at(TimePoint time) const;
  // The cell time that is told as `wall`, which was before the beginning: less than zero, or zero
  // where the wall's clock was set back since.
  [[nodiscard]] TimePoint time_before(Wall wall) const;
  // Cell seconds per wall second, of now.
  [[nodiscard]] double speed() const { return anchors_.back().speed; }
  // As rfc3339().
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
