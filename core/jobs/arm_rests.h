#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/jobs/step.h"
#include "core/model/cell.h"
#include "core/sequence/safe_sequence.h"

namespace armloom {

// Holds where clients left the arms that have retreated since, and the motions back. Clients
// need not know about retreats. A copy is independent of the original.
class WaysBack {
 public:
  // The arm has no client job, and retreats along `way`.
  void retreat(ArmId arm, const Trajectory& way);
  // A client submits this motion; the jobs before it leave all joints at `rest`. Returns motions
  // that first bring its arms back, if more of its joints then stand where it begins, and sets
  // `rest` to their ends. Forgets the ways back of arms that return or that the motion moves away.
  std::vector<TrajectoryPtr> take(const Cell& cell, const Trajectory& motion, Configuration& rest);

 private:
  std::map<ArmId, TrajectoryPtr> by_arm_;
};

// Rest positions of the arms, and stopped arms.
class ArmRests {
 public:
  // Throws std::invalid_argument unless `rest` has a value for every joint of the cell.
  ArmRests(const Cell& cell, Configuration rest);
  // A copy is independent. Not assignable: only the transitions change the rests.
  ArmRests(const ArmRests&) = default;
  ArmRests(ArmRests&&) = default;

  // Returns the rest position of every joint (rad, m); for a moving joint, the position where it
  // started.
  [[nodiscard]] const Configuration& rest() const { return rest_; }
  [[nodiscard]] const PlacePtr& place(ArmId arm) const { return places_at_[arm.index()]; }
  [[nodiscard]] const std::vector<PlacePtr>& places() const { return places_at_; }
  // Returns the motion that brought the arm to its rest; null if there is none or if it moved
  // several arms.
  [[nodiscard]] const TrajectoryPtr& came_by(ArmId arm) const { return came_by_[arm.index()]; }

  // Stores that the arm may be anywhere until set_located(), and which other arms it could meet.
  void set_unlocated(ArmId arm, std::vector<ArmId> may_meet);
  // Returns the arms that it could have met.
  std::vector<ArmId> set_located(ArmId arm);
  [[nodiscard]] bool is_unlocated(ArmId arm) const { return may_meet_.contains(arm); }
  // Returns an arm that may be anywhere and that this arm could meet; nullopt if there is none.
  [[nodiscard]] std::optional<ArmId> unlocated_beside(ArmId arm) const;

  [[nodiscard]] WaysBack& ways_back() { return ways_back_; }
  [[nodiscard]] const WaysBack& ways_back() const { return ways_back_; }
  void resume(ArmId arm);
  [[nodiscard]] bool is_stopped(ArmId arm) const { return stop_of(arm).has_value(); }
  // A stop of an arm that has not ended.
  struct StopOfArm {
    std::string cause;
    bool until_connected = false;  // Stop::StoppedArm
  };
  [[nodiscard]] const std::optional<StopOfArm>& stop_of(ArmId arm) const {
    return stopped_[arm.index()];
  }
  [[nodiscard]] std::optional<Wait> stop_of(const Step& step) const;

  // Returns true if joints of the motion (of `arm`, if set) rest elsewhere than at its start.
  [[nodiscard]] bool begins_elsewhere(const Cell& cell, const Trajectory& trajectory,
                                      std::optional<ArmId> arm = {}) const;
  // Returns the detail of Reason::start_mismatch; nullopt without a mismatch.
  [[nodiscard]] std::optional<std::string> start_mismatch(const Cell& cell,
                                                          const Trajectory& trajectory) const;

  // Grows when a rest or a stop changes, and when an arm is located or no longer located.
  [[nodiscard]] Version changes() const { return changes_; }

 private:
  friend class StateWriter;
  friend class Transitions;

  // Stores that the motion's arms rest at `position` (of the trajectory's joints, in its order).
  void come_to_rest(const Cell& cell, const TrajectoryPtr& motion, const Eigen::VectorXd& position);
  // Stores that the arm was found at `position` (Located).
  void locate(const Cell& cell, ArmId arm, const Eigen::VectorXd& position);
  // Stores the leg's end as the place of its arms, although they may rest a little off the goal.
  // Does not change rest().
  void rest_at_goal(const WaitingLeg& leg);
  // Stops the arm. Its first cause stays, but any other cause replaces a stop until the connection.
  void stop(ArmId arm, std::string cause, bool until_connected = false);
  [[nodiscard]] WaitingLeg leg_of(const Cell& cell, StepId step, const Trajectory& motion);

  Version changes_ = 0;
  Configuration rest_;
  std::vector<std::optional<StopOfArm>> stopped_;  // per arm
  std::map<ArmId, std::vector<ArmId>> may_meet_;   // of unlocated arms that could meet others
  std::vector<TrajectoryPtr> came_by_;
  WaysBack ways_back_;
  Places places_;
  std::vector<PlacePtr> places_at_;  // per arm: its rest, or its start while it moves
};

}  // namespace armloom
