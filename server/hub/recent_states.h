#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>

#include "core/base/time.h"
#include "core/model/cell.h"

namespace armloom {

// Where every joint was measured over the last minutes, for who comes only now: a ring of
// kFramesMax frames, one each kPeriod of wall time at most, so that it spans five minutes and takes
// some 250 kB and 24 kB for each joint. Not thread-safe: the server's thread.
class RecentStates {
 public:
  using Clock = std::chrono::steady_clock;
  inline static constexpr std::chrono::milliseconds kPeriod{100};
  inline static constexpr std::size_t kFramesMax = 3000;

  struct Frame {
    TimePoint time;
    Configuration q;  // all joints of the cell
  };
  using FramePtr = std::shared_ptr<const Frame>;

  // `now`, the wall's, and `time` do not go backwards from call to call.
  void take(TimePoint time, const Configuration& q, Clock::time_point now);

  // Oldest first; immutable, so that they may be read elsewhere.
  [[nodiscard]] const std::deque<FramePtr>& frames() const { return frames_; }

 private:
  std::deque<FramePtr> frames_;
  Clock::time_point next_{};
};

}  // namespace armloom
