#pragma once

#include "core/monitor/observation.h"
#include "core/trajectory/rate_law.h"

namespace armloom {

// Where an arm can come to rest at the earliest: it brakes now, as hard as its brake limits permit.
// An arm that keeps its contract can always come to rest at its authority. Pure; not thread-safe.
class EarliestRest {
 public:
  explicit EarliestRest(CellPtr cell) : cell_(cell), law_(std::move(cell)) {}

  // Takes what is known of the arm in this period. Precondition: the arm has a motion.
  void observe(const ArmObservation& now);
  // Returns the progress where the arm can rest at the earliest, if that is beyond its authority.
  // Else it returns the measured progress.
  [[nodiscard]] Duration beyond(const ArmObservation& now);
  // Returns the longest way from a brake to the rest, anywhere on the motion (stopping_reach_s).
  [[nodiscard]] Duration stopping_reach() const { return reach_; }

 private:
  CellPtr cell_;
  RateLaw law_;
  TrajectoryPtr motion_;
  Duration reach_{};
  // The commanded progress of the last two reports, and the mean rate between them; with a payload,
  // the rate from which an arm with empty hands stops within the same distance.
  Duration before_{}, last_{};
  ReportTime last_at_;
  double rate_ = 0.0;
};

}  // namespace armloom
