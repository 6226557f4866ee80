#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"

namespace armloom {

// Speed override: the largest share, 0 to 1, of the planned rate of motions. An operator sets one
// share for the cell and one for each arm. What an arm holds gives a third one, the square root of
// the brake that it keeps (core/model/payload.h). An arm goes at the product, but if none is 0, at
// kSmallestShare or more. A motion of several arms goes at the smallest share of its arms, so that
// they keep in step.
//
// Also keeps the motion clock, by which backlog timeouts and aging are measured. It runs at the
// smallest share of all arms, so that no job expires because its blocker was slowed down. It equals
// cell time as long as all shares are 1.
class SpeedOverride {
 public:
  // A share is 0, or at least this.
  static constexpr double kSmallestShare = 0.001;
  [[nodiscard]] static constexpr bool is_valid(double share) {
    return share == 0.0 || (share >= kSmallestShare && share <= 1.0);
  }

  explicit SpeedOverride(std::size_t arms) : arms_(arms, 1.0), brakes_(arms, 1.0) {}

  // Sets the share of the arm, or of the cell. Precondition: is_valid(share); `now` never
  // decreases.
  void set(std::optional<ArmId> arm, double share, TimePoint now) {
    clock_ = clock(now);
    since_ = now;
    (arm ? arms_[arm->index()] : cell_) = share;
  }

  // The arm keeps this share of its brake from now on; 0 if it holds too much, and may not move.
  void set_brake(ArmId arm, double share) { brakes_[arm.index()] = share; }

  [[nodiscard]] double cell() const { return cell_; }
  [[nodiscard]] double brake(ArmId arm) const { return brakes_[arm.index()]; }
  [[nodiscard]] double arm(ArmId arm) const { return arms_[arm.index()]; }
  // Return the share at which the arm, or a motion of these arms, goes.
  [[nodiscard]] double effective(ArmId arm) const {
    return product(product(cell_, arms_[arm.index()]), std::sqrt(brakes_[arm.index()]));
  }
  [[nodiscard]] double effective(const std::vector<ArmId>& arms) const {
    double smallest = 1.0;
    for (const ArmId arm : arms) smallest = std::min(smallest, effective(arm));
    return smallest;
  }
  // Returns the cell time per trajectory time that is predicted for a motion of these arms. At
  // share 0 it is large but finite: orders are chosen as if the arms came last.
  [[nodiscard]] double pace(const std::vector<ArmId>& arms) const {
    return 1.0 / std::max(effective(arms), kSmallestShare);
  }

  // Returns the motion clock at `now`. Precondition: `now` is not before the last set().
  [[nodiscard]] TimePoint clock(TimePoint now) const {
    const double share = slowest();
    return share == 1.0 ? clock_ + (now - since_)
                        : clock_ + from_seconds(to_seconds(now - since_) * share);
  }
  // Returns when the motion clock will show `due` at the present shares; TimePoint::max() if never.
  [[nodiscard]] TimePoint when(TimePoint due) const {
    const double share = slowest();
    if (share == 1.0 || due <= clock_) return since_ + (due - clock_);
    if (share == 0.0) return TimePoint::max();
    // Rounded up, so that the clock has reached `due` by then.
    return since_ + from_seconds(to_seconds(due - clock_) / share) + Duration{1};
  }

 private:
  [[nodiscard]] static double product(double a, double b) {
    return a == 0.0 || b == 0.0 ? 0.0 : std::max(a * b, kSmallestShare);
  }
  [[nodiscard]] double slowest() const { return product(cell_, std::ranges::min(arms_)); }

  double cell_ = 1.0;
  std::vector<double> arms_;    // ArmId
  std::vector<double> brakes_;  // ArmId
  TimePoint since_{};           // last set()
  TimePoint clock_{};           // the motion clock then
};

}  // namespace armloom
