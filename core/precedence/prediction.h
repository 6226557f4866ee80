#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/time.h"
#include "core/precedence/coordinated_motion.h"
#include "core/precedence/motion_chains.h"
#include "core/precedence/precedence.h"

namespace armloom {

// A precedence as input of predict(): `second` may pass when `first` has progressed far enough.
// Both are indices of motions.
struct Dependency {
  std::size_t first;
  std::size_t second;
  const Precedence* precedence;
};

// Predicted times, relative to now, if every motion keeps its pace and waits only where it must.
class Prediction {
 public:
  // A motion is at `progress` at `time`, and continues at its pace to the progress of the next
  // stage.
  struct Stage {
    Duration progress;
    Duration time;
  };
  // Returns the cell time that the motion takes for `way` of trajectory time.
  [[nodiscard]] Duration time_for(std::size_t motion, Duration way) const {
    return paced(way, pace_[motion]);
  }
  // Returns the motion's stages, up to its end or to where it is stuck; empty if it never begins.
  [[nodiscard]] std::span<const Stage> stages(std::size_t motion) const {
    return {stages_.data() + first_[motion], count_[motion]};
  }
  // Return when the motion reaches `progress`, and when it continues from there; nullopt if it
  // never does.
  [[nodiscard]] std::optional<Duration> comes_to(std::size_t motion, Duration progress) const;
  [[nodiscard]] std::optional<Duration> goes_beyond(std::size_t motion, Duration progress) const;

  std::vector<Duration> begins = {};    // when each motion leaves its start; zero if it has begun
  std::vector<Duration> ends = {};      // when each motion ends; valid only if it is not in `stuck`
  std::vector<std::size_t> stuck = {};  // ascending: motions that never end
  // If any is stuck: motions that wait for each other, or one motion that is held.
  std::vector<std::size_t> ring = {};

 private:
  friend class Race;
  std::vector<Stage> stages_ = {};
  std::vector<std::size_t> first_ = {};  // index of each motion's first stage
  std::vector<std::size_t> count_ = {};
  std::vector<double> pace_ = {};
};

// Time added by a stop on the path and the start after it.
inline constexpr Duration kPauseLoss = std::chrono::milliseconds(300);

// By motion: the progress beyond which it does not go, because an arm rests in its path. Empty:
// none is held.
using HeldAt = std::vector<std::optional<Duration>>;

// Predicts the motions from the precedences and the running orders of the arms (`chains`, which may
// contain more motions behind these). These form a graph over progress; unless a motion is held, it
// is acyclic exactly if `stuck` is empty. Takes time linear in the steps of all precedences, except
// for sorting them.
[[nodiscard]] Prediction predict(std::span<const CoordinatedMotion> motions,
                                 const MotionChains& chains,
                                 const std::vector<Dependency>& dependencies,
                                 const HeldAt& held_at = {});

}  // namespace armloom
