#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "core/base/time.h"
#include "core/model/cell.h"

namespace armloom {

// Measured positions of all joints in the last five minutes, for clients that connect later. Keeps
// kFramesMax frames, at most one per kPeriod of wall time. This takes about 250 kB, plus 24 kB for
// each joint. Use on the server's thread.
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

  // Precondition: `now` (wall time) and `time` do not decrease between calls.
  void take(TimePoint time, const Configuration& q, Clock::time_point now);

  // Calls then(frames later than `after`), as soon as there are any: now, or with a later take().
  // At the first take() from `deadline` on, there may be none.
  using Then = std::function<void(std::vector<FramePtr>)>;
  void when_later(TimePoint after, Clock::time_point deadline, Then then);

  [[nodiscard]] std::vector<FramePtr> later_than(TimePoint after) const;
  // Oldest first. The frames are immutable, so other threads may read them.
  [[nodiscard]] const std::deque<FramePtr>& frames() const { return frames_; }

 private:
  struct Waiting {
    TimePoint after;
    Clock::time_point deadline;
    Then then;
  };
  std::deque<FramePtr> frames_;
  std::vector<Waiting> waiting_;
  Clock::time_point next_{};
};

}  // namespace armloom
