#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/jobs/job.h"
#include "core/model/cell.h"
#include "core/sequence/safe_sequence.h"

namespace armloom {

// Where the arms of a cell rest, and which of them start nothing for now.
class ArmRests {
 public:
  // `rest`: of every joint of the cell; throws std::invalid_argument if it has another size.
  ArmRests(const Cell& cell, Configuration rest);

  // Where every joint stands, as far as it is not in motion; there where it set out.
  [[nodiscard]] const Configuration& rest() const { return rest_; }
  [[nodiscard]] const PlacePtr& place(ArmId arm) const { return places_at_[arm.index()]; }
  [[nodiscard]] const std::vector<PlacePtr>& places() const { return places_at_; }
  // The motion on which it came to rest; or null.
  [[nodiscard]] const TrajectoryPtr& came_by(ArmId arm) const { return came_by_[arm.index()]; }

  // At `position` of the trajectory's joints, in its order.
  void come_to_rest(const Cell& cell, const TrajectoryPtr& motion, const Eigen::VectorXd& position);
  // At its goal, it counts as standing exactly there.
  void rest_at_goal(const WaitingLeg& leg);

  void stop(ArmId arm, std::string cause) { stopped_[arm.index()] = std::move(cause); }
  void resume(ArmId arm) { stopped_[arm.index()].reset(); }
  [[nodiscard]] bool is_stopped(ArmId arm) const { return stop_cause(arm).has_value(); }
  [[nodiscard]] const std::optional<std::string>& stop_cause(ArmId arm) const {
    return stopped_[arm.index()];
  }
  [[nodiscard]] std::optional<Wait> stop_of(const Job& job) const;

  // A motion of these arms as a leg of their lanes.
  [[nodiscard]] WaitingLeg leg_of(const Cell& cell, JobId job, const Trajectory& motion);
  // The first joint that stands elsewhere than where the trajectory begins, by more than
  // execution.start_tolerance_rad; of this arm only, if given.
  [[nodiscard]] std::optional<JointId> begins_elsewhere(const Cell& cell,
                                                        const Trajectory& trajectory,
                                                        std::optional<ArmId> arm = {}) const;
  // Why it cannot begin where the arms stand.
  [[nodiscard]] std::optional<std::string> start_mismatch(const Cell& cell,
                                                          const Trajectory& trajectory) const;

 private:
  Configuration rest_;
  std::vector<std::optional<std::string>> stopped_;  // per arm: the cause
  std::vector<TrajectoryPtr> came_by_;
  Places places_;
  std::vector<PlacePtr> places_at_;  // per arm: where it rests, or came from
};

// Whether the motion of that arm may begin with it there (execution.start_tolerance_rad).
[[nodiscard]] bool begins_at(const Cell& cell, const Trajectory& motion, const Place& place);

}  // namespace armloom
