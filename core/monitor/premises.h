#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/enumeration.h"
#include "core/monitor/earliest_rest.h"
#include "core/monitor/finding.h"
#include "core/monitor/moves_on.h"
#include "core/monitor/observation.h"
#include "core/monitor/path_distance.h"

namespace armloom {

// Checks on measured data what certificates take for granted: each joint stays close to its path or
// rest, each arm can come to rest at its authority, and feedback is new and plausible. A lagging
// arm is no violation. Pure; deterministic; not thread-safe.
class PremiseCheck {
 public:
  using Kind = MonitorFinding::Kind;
  explicit PremiseCheck(CellPtr cell);

  // Returns the new findings of this period; each stops its arm, except
  // late_feedback. A violation is reported when it begins, and again if the arm moves on after it
  // came to rest, or was resumed. A violation begins if it did not hold for kSameCondition. `time`
  // grows from call to call.
  [[nodiscard]] std::vector<MonitorFinding> check(const Observation& seen);
  // The arm is no longer stopped: each violation that still holds is reported again.
  void resumed(ArmId arm);
  // Checks an arm whose controller reports "finished". Returns a finding if it is not at the goal.
  [[nodiscard]] std::optional<MonitorFinding> finished(ArmId arm, const Trajectory& motion,
                                                       const Configuration& measured,
                                                       TimePoint now) const;

  // Returns the distance of the arm from its path if it exceeds the limit, else zero (rad, m). As
  // of the last check().
  [[nodiscard]] double deviation(ArmId arm) const { return arms_[arm.index()].deviation; }
  // Returns false if the arm is not where its certificates assume: it deviates, moves without a
  // motion, or does not keep its authority.
  [[nodiscard]] bool is_as_certified(ArmId arm) const { return arms_[arm.index()].as_certified; }
  // Returns false if the arm is beyond its authority, or cannot come to rest there any more.
  [[nodiscard]] bool keeps_authority(ArmId arm) const { return arms_[arm.index()].keeps_authority; }
  // Returns the longest way from a brake to the rest on the arm's motion, which it must have.
  [[nodiscard]] Duration stopping_reach(ArmId arm) const {
    return arms_[arm.index()].earliest_rest.stopping_reach();
  }
  // Returns true if the arm moved away from its rest and stands still again. An arm whose
  // measurements are noisy beyond its tracking error does not stand still.
  [[nodiscard]] bool rests_elsewhere(ArmId arm) const { return arms_[arm.index()].elsewhere; }
  // Returns the velocities of all joints (rad/s, m/s), measured between the last two reports of
  // their arms.
  [[nodiscard]] const Configuration& velocity() const { return velocity_; }

  // Returns the point of the arm's motion that is nearest to the measured positions, between the
  // measured and the commanded progress. Precondition: the arm has a motion.
  [[nodiscard]] PathDistance nearest(ArmId arm, const Observation& seen) const;
  // Returns the joints of the arm and of its gripper.
  [[nodiscard]] const std::vector<JointId>& joints(ArmId arm) const {
    return arms_[arm.index()].joints;
  }

  [[nodiscard]] static double tracking_error(const Cell& cell, ArmId arm);
  // Returns how fast a joint can move (rad/s, m/s). Positions that change faster are wrong.
  [[nodiscard]] static double velocity_limit(const Cell& cell, JointId joint);

 private:
  struct Violation {
    std::optional<TimePoint> held_at = {};  // last time
    bool has_rested = false;                // since it was reported
  };
  struct ArmState {
    EarliestRest earliest_rest;
    std::vector<JointId> joints = {};  // of the arm and its gripper
    Configuration rest = {};           // by JointId, where each joint rests
    bool rested = false;               // in the last check
    ArmObservation last = {};
    TimePoint changed_at{};     // when the positions last changed
    Duration commanded_then{};  // commanded progress then
    // Set while it rests, until it stands still: when it last moved by more than its limit.
    std::optional<TimePoint> moved_at = {};
    TimePoint braked_at{};     // when the monitor stopped its unplanned motion
    MovesOn moves_on = {};     // after that brake
    MovesOn after_brake = {};  // since it should stand, if it was braked on a motion
    std::optional<TimePoint> braking_since = {};  // of after_brake
    double deviation = 0.0;
    bool as_certified = true;
    bool keeps_authority = true;
    bool elsewhere = false;  // rests_elsewhere()
    std::array<Violation, kValueCount<Kind>> violations = {};
  };
  // Returns true if the arm's last report is too old.
  bool check_feedback(ArmId arm, const Observation& seen, std::vector<MonitorFinding>& found);
  void check_change(ArmId arm, const Observation& seen, Duration elapsed,
                    std::vector<MonitorFinding>& found);
  void check_path(ArmId arm, const Observation& seen, std::vector<MonitorFinding>& found);
  void check_rest(ArmId arm, const Observation& seen, std::vector<MonitorFinding>& found);
  [[nodiscard]] Duration stopping_time(ArmId arm, bool has_motion, double brake) const;
  void check_stop(ArmId arm, const Observation& seen, std::vector<MonitorFinding>& found);
  void begin_motion(ArmId arm, const Observation& seen);
  void begin_rest(ArmId arm, const Observation& seen);
  static void set_rest(ArmState& state, const Configuration& measured);
  void judge(ArmId arm, bool holds, bool rests, MonitorFinding finding,
             std::vector<MonitorFinding>& found);

  CellPtr cell_;
  std::vector<ArmState> arms_;
  std::optional<TimePoint> time_;
  Configuration measured_, velocity_;
};

}  // namespace armloom
