#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/time.h"
#include "core/precedence/precedence.h"

namespace armloom {

// A motion as the prediction sees it.
struct MotionAhead {
  Duration progress;                        // where it is
  Duration duration;                        // of its trajectory
  std::span<const std::size_t> after = {};  // motions of the same arms that end before it begins
  std::optional<Duration> held_at = {};     // goes no farther than this, as things are
  Duration stands_for{};                    // before it goes on
  double pace = 1.0;                        // of time for one of its trajectory
};

// `second` may pass as Precedence says when `first` has got far enough. Indices into the motions.
struct Dependency {
  std::size_t first;
  std::size_t second;
  const Precedence* precedence;
};

[[nodiscard]] inline Duration paced(Duration way, double pace) {
  return pace == 1.0 ? way : from_seconds(to_seconds(way) * pace);
}

// When everything goes as fast as its trajectory and its pace say, and waits where it has to. All
// times count from now.
class Prediction {
 public:
  // How a motion advances: at `progress` at `time`, from there at its pace to the next entry.
  struct Stage {
    Duration progress;
    Duration time;
  };
  // What it takes for so much of a motion's way.
  [[nodiscard]] Duration time_for(std::size_t motion, Duration way) const {
    return paced(way, pace_[motion]);
  }
  // Up to where it comes; empty: it never begins.
  [[nodiscard]] std::span<const Stage> stages(std::size_t motion) const {
    return {stages_.data() + first_[motion], count_[motion]};
  }
  // When the motion comes to `progress`, and when it goes on from there; nothing: never.
  [[nodiscard]] std::optional<Duration> comes_to(std::size_t motion, Duration progress) const;
  [[nodiscard]] std::optional<Duration> goes_beyond(std::size_t motion, Duration progress) const;

  std::vector<Duration> begins = {};    // leaves its start; zero: has begun
  std::vector<Duration> ends = {};      // of motions that come to their end
  std::vector<std::size_t> stuck = {};  // ascending: motions that never do: they wait in a ring
  std::vector<std::size_t> ring = {};   // one of these rings: each waits for the next, the last for
                                        // the first
 private:
  friend class Race;
  std::vector<Stage> stages_ = {};
  std::vector<std::size_t> first_ = {};  // of each motion's stages
  std::vector<std::size_t> count_ = {};
  std::vector<double> pace_ = {};
};

// What a stop on the way and the start after it cost besides the wait.
inline constexpr Duration kPauseLoss = std::chrono::milliseconds(300);

// The precedences of motions, and their orders per arm, as one graph over progress: it is acyclic
// exactly when nobody is stuck. Linear in the steps of all precedences, but for sorting them.
[[nodiscard]] Prediction predict(const std::vector<MotionAhead>& motions,
                                 const std::vector<Dependency>& dependencies);

}  // namespace armloom
