#pragma once

#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/conflict_region.h"

namespace armloom {

// Returns the cell time that `way` of trajectory time takes at this pace.
[[nodiscard]] inline Duration paced(Duration way, double pace) {
  return pace == 1.0 ? way : from_seconds(to_seconds(way) * pace);
}

// Returns the rectangle with A and B swapped.
[[nodiscard]] inline ProgressBox turned_around(const ProgressBox& box) {
  return {box.from_b, box.to_b, box.from_a, box.to_a};
}

// Trajectory time by which a waiting motion stops before a region. Regions with other motions of
// the same other arm have slightly different outlines. With this distance they do not begin before
// the position of the waiting motion.
inline constexpr Duration kShortOf = std::chrono::milliseconds(20);

// The passing order in one conflict region of two motions: `first` leaves every box before `second`
// enters it. The order compares progress (trajectory time), never clocks, so it holds however late
// either motion is. (An action dependency between two plans: Hoenig et al. 2019.)
class Precedence {
 public:
  // `region`: of the motions A and B, in this order. With `waits_at_start`, the second motion
  // leaves its start only when it can pass without a stop, if both motions then keep their pace.
  // `pace_ratio`: pace of the second motion / pace of the first (Outlook::pace). It affects only
  // when the second motion leaves its start.
  Precedence(StepId a, StepId b, const ConflictRegion& region, bool a_first,
             bool waits_at_start = false, double pace_ratio = 1.0);

  [[nodiscard]] StepId first() const { return first_; }
  [[nodiscard]] StepId second() const { return second_; }
  [[nodiscard]] bool waits_at_start() const { return waits_at_start_; }
  // Returns the region with `first` as A: times with suffix _a, and body_a of the evidence, belong
  // to `first`.
  [[nodiscard]] const ConflictRegion& region() const { return region_; }

  // While the progress of `first` is less than `until`, the authority of `second` is at most
  // `limit`. Both grow from step to step; after the last step there is no limit.
  struct Step {
    Duration until;
    Duration limit;
  };
  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
  // Returns the largest authority that `second` may have; nullopt if this order no longer limits
  // it.
  [[nodiscard]] std::optional<Duration> limit(Duration progress_of_first) const;

 private:
  StepId first_;
  StepId second_;
  bool waits_at_start_;
  ConflictRegion region_;
  std::vector<Step> steps_;
};

}  // namespace armloom
