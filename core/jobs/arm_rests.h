#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/jobs/job.h"
#include "core/model/cell.h"
#include "core/sequence/safe_sequence.h"

namespace armloom {

// Where the arms of a cell rest, and which arms are stopped.
class ArmRests {
 public:
  // `rest` has one value for each joint of the cell; throws std::invalid_argument otherwise.
  ArmRests(const Cell& cell, Configuration rest);

  // Returns the rest position of every joint; for a moving joint the position where it started.
  [[nodiscard]] const Configuration& rest() const { return rest_; }
  [[nodiscard]] const PlacePtr& place(ArmId arm) const { return places_at_[arm.index()]; }
  [[nodiscard]] const std::vector<PlacePtr>& places() const { return places_at_; }
  // Returns the motion that brought the arm to its rest; null if there is none, or if it moved
  // several arms.
  [[nodiscard]] const TrajectoryPtr& came_by(ArmId arm) const { return came_by_[arm.index()]; }

  // Sets the rest to `position`, in the order of the trajectory's joints.
  void come_to_rest(const Cell& cell, const TrajectoryPtr& motion, const Eigen::VectorXd& position);
  // Places the arms exactly at the goal, ignoring small deviations.
  void rest_at_goal(const WaitingLeg& leg);

  void stop(ArmId arm, std::string cause) { stopped_[arm.index()] = std::move(cause); }
  void resume(ArmId arm) { stopped_[arm.index()].reset(); }
  [[nodiscard]] bool is_stopped(ArmId arm) const { return stop_cause(arm).has_value(); }
  [[nodiscard]] const std::optional<std::string>& stop_cause(ArmId arm) const {
    return stopped_[arm.index()];
  }
  [[nodiscard]] std::optional<Wait> stop_of(const Job& job) const;

  // Returns the motion as a leg of the safe sequence.
  [[nodiscard]] WaitingLeg leg_of(const Cell& cell, JobId job, const Trajectory& motion);
  // Returns the first joint whose rest differs from the trajectory's start by more than
  // execution.start_tolerance_rad; nullopt if there is none. With `arm`, only joints of that arm
  // are compared.
  [[nodiscard]] std::optional<JointId> begins_elsewhere(const Cell& cell,
                                                        const Trajectory& trajectory,
                                                        std::optional<ArmId> arm = {}) const;
  // Returns the sentence for Reason::start_mismatch; nullopt if the trajectory begins where the
  // arms rest.
  [[nodiscard]] std::optional<std::string> start_mismatch(const Cell& cell,
                                                          const Trajectory& trajectory) const;

 private:
  Configuration rest_;
  std::vector<std::optional<std::string>> stopped_;  // per arm: the cause
  std::vector<TrajectoryPtr> came_by_;
  Places places_;
  std::vector<PlacePtr> places_at_;  // per arm: where it rests, or where it started
};

// Returns true if the arm at `place` is at the motion's start within execution.start_tolerance_rad.
[[nodiscard]] bool begins_at(const Cell& cell, const Trajectory& motion, const Place& place);

}  // namespace armloom
