#pragma once

#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/conflict_region.h"

namespace armloom {

// Who waits stays so far short of a region: what its arm then meets in another motion of the other
// one, whose regions have an outline of their own, begins no earlier than where it stands.
inline constexpr Duration kShortOf = std::chrono::milliseconds(20);

// The passing order in one conflict region of two motions: `first` leaves every box before `second`
// comes to it. Compared by progress (trajectory time), never by clocks, so that it holds however
// late either of them is (an action dependency between two plans: Hoenig et al. 2019).
class Precedence {
 public:
  // `region` is of motions A and B in this order. `waits_at_start`: the second does not leave its
  // start before it can pass without a stop, if from then on both go on by the clock.
  Precedence(JobId a, JobId b, const ConflictRegion& region, bool a_first,
             bool waits_at_start = false);

  [[nodiscard]] JobId first() const { return first_; }
  [[nodiscard]] JobId second() const { return second_; }
  [[nodiscard]] bool waits_at_start() const { return waits_at_start_; }
  // With times of `first` as A's; body_a of the evidence is first's.
  [[nodiscard]] const ConflictRegion& region() const { return region_; }

  // While the progress of `first` is less than `until`, the authority of `second` is no more than
  // `limit`. Both grow from step to step; beyond the last there is no limit.
  struct Step {
    Duration until;
    Duration limit;
  };
  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
  // The authority of `second`; nothing: not limited any more.
  [[nodiscard]] std::optional<Duration> limit(Duration progress_of_first) const;

 private:
  JobId first_;
  JobId second_;
  bool waits_at_start_;
  ConflictRegion region_;
  std::vector<Step> steps_;
};

}  // namespace armloom
