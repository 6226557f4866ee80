#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/time.h"
#include "core/precedence/precedence.h"

namespace armloom {

// A motion as input of the prediction.
struct MotionAhead {
  Duration progress;                        // its present progress
  Duration duration;                        // of its trajectory
  std::span<const std::size_t> after = {};  // motions of the same arms that end before it begins
  std::optional<Duration> held_at = {};     // does not go beyond this progress
  Duration stands_for{};                    // rests for so long before it goes on
  double pace = 1.0;                        // cell time per trajectory time
};

// `second` may pass, as Precedence says, when `first` has progressed far enough. Indices of
// motions.
struct Dependency {
  std::size_t first;
  std::size_t second;
  const Precedence* precedence;
};

[[nodiscard]] inline Duration paced(Duration way, double pace) {
  return pace == 1.0 ? way : from_seconds(to_seconds(way) * pace);
}

// The predicted times if every motion keeps its pace and waits where it must. Times are relative to
// now.
class Prediction {
 public:
  // A motion is at `progress` at `time`, and continues at its pace to the next entry.
  struct Stage {
    Duration progress;
    Duration time;
  };
  // Returns the time that the motion takes for `way` of trajectory time.
  [[nodiscard]] Duration time_for(std::size_t motion, Duration way) const {
    return paced(way, pace_[motion]);
  }
  // Up to where it gets; empty if it never begins.
  [[nodiscard]] std::span<const Stage> stages(std::size_t motion) const {
    return {stages_.data() + first_[motion], count_[motion]};
  }
  // Return when the motion reaches `progress`, and when it continues from there; nullopt: never.
  [[nodiscard]] std::optional<Duration> comes_to(std::size_t motion, Duration progress) const;
  [[nodiscard]] std::optional<Duration> goes_beyond(std::size_t motion, Duration progress) const;

  std::vector<Duration> begins = {};    // when it leaves its start; zero if it has begun
  std::vector<Duration> ends = {};      // of motions that reach their end
  std::vector<std::size_t> stuck = {};  // ascending: motions that never end
  std::vector<std::size_t> ring = {};   // a cycle of waits, or one motion at its held_at
 private:
  friend class Race;
  std::vector<Stage> stages_ = {};
  std::vector<std::size_t> first_ = {};  // index of each motion's first stage
  std::vector<std::size_t> count_ = {};
  std::vector<double> pace_ = {};
};

// Time added by a stop on the path and the start after it.
inline constexpr Duration kPauseLoss = std::chrono::milliseconds(300);

// Predicts from the precedences and running orders, one graph over progress: it is acyclic exactly
// if `stuck` is empty. Linear in the steps of all precedences, except for sorting them.
[[nodiscard]] Prediction predict(const std::vector<MotionAhead>& motions,
                                 const std::vector<Dependency>& dependencies);

}  // namespace armloom
