#pragma once

#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/arm/arm_link.h"
#include "core/coordination/in_step.h"
#include "core/jobs/inputs.h"
#include "core/model/cell.h"

namespace armloom {

// Sends a step's trajectory to the controllers of its arms and joins their feedback into one
// report: the progress of the last arm, and one end. If one arm faults, the other arms of the
// motion are braked. An arm that leads by more than out_of_step() (core/coordination/in_step.h)
// waits on the path. Authority never exceeds the last known progress of the last arm by more than
// out_of_step() plus the stopping reach, so the arms stay together even if feedback is lost.
class Motions {
 public:
  Motions(CellPtr cell, std::vector<std::unique_ptr<ArmController>> controllers,
          Configuration measured);

  void dispatch(const Dispatch& dispatch, const TrajectoryPtr& trajectory);
  void grant(const Grant& grant);
  void brake(StepId step);
  // Brakes an arm that may have no motion.
  void brake(ArmId arm, StopCategory category) { command(arm, ArmCommand::Brake{category}); }
  void brake_all();
  // Sets the speed of each arm (ArmId). The arms of one motion get their smallest shares.
  void set_speed(std::vector<ArmCommand::SetSpeed> speeds);
  [[nodiscard]] const ArmCommand::SetSpeed& speed(ArmId arm) const { return speeds_[arm.index()]; }
  void release(StepId step);

  // Runs one control cycle of every arm. Returns the reports for the scheduler, in order of steps.
  [[nodiscard]] const std::vector<MotionReport>& tick(TimePoint now);
  // Runs the arms' part of a cycle only, as if the executive had stopped.
  void tick_arms(TimePoint now);

  // Returns the positions measured in the last tick, of all joints of the cell (rad, m).
  [[nodiscard]] const Configuration& measured() const { return measured_; }
  [[nodiscard]] const ArmFeedback& feedback(ArmId arm) const { return link(arm).feedback(); }
  [[nodiscard]] const ArmLink& link(ArmId arm) const { return arms_[arm.index()].link; }
  // Returns the joints of the arm and of its gripper, in the order of its reports.
  [[nodiscard]] const std::vector<JointId>& joints(ArmId arm) const {
    return arms_[arm.index()].controller->joints();
  }
  // Positions of all joints in the last tick as they really were, where arms are simulated; else as
  // measured.
  [[nodiscard]] const Configuration& true_positions() const { return truth_; }
  [[nodiscard]] bool moving(ArmId arm) const;
  // Returns true if the arm progressed on its path in the last tick; false in a pause.
  [[nodiscard]] bool advances(ArmId arm) const { return arms_[arm.index()].advances; }
  // Returns how often the arm was dispatched, resumes included.
  [[nodiscard]] std::uint64_t starts(ArmId arm) const { return arms_[arm.index()].starts; }
  [[nodiscard]] bool all_at_rest() const;
  // Returns true if all arms rest, and stay at rest until the next command.
  [[nodiscard]] bool all_settled() const;
  // Returns the distance of the arm's joints from one point of its path between the measured and
  // the commanded progress (rad, m): of the nearest point, or of the first that is at most `enough`
  // away. Zero without a motion.
  [[nodiscard]] double deviation(ArmId arm, double enough) const;
  // Returns the largest authority granted to the arm's motion so far; zero without a motion.
  [[nodiscard]] Duration granted(ArmId arm) const;
  // Returns null if the arm has no motion.
  [[nodiscard]] TrajectoryPtr trajectory(ArmId arm) const;
  // An arm of a motion under way; times are trajectory time. under_way() returns them in order of
  // steps.
  struct UnderWay {
    ArmId arm;
    StepId step;
    Duration progress;  // measured
    Duration authority;
  };
  [[nodiscard]] std::vector<UnderWay> under_way() const;

 private:
  // A view of a dispatched step: what its arms were told.
  struct Motion {
    TrajectoryPtr trajectory;
    std::map<ArmId, Duration> stands_at{};  // measured, after a brake
    Duration authority{};
    Duration granted_max{};  // largest authority so far
    // For motions of several arms: largest lead of an arm's authority over the last arm.
    Duration ahead_max{};
    Duration out_of_step{};
    Duration handed_on{};
    bool resting = false;  // its end was reported
    bool braking = false;
  };
  struct LinkedArm {
    std::unique_ptr<ArmController> controller;
    ArmLink link;
    bool advances = false;
    std::uint64_t starts = 0;
  };
  template <class Command>
  void command(ArmId arm, Command what) {
    LinkedArm& to = arms_[arm.index()];
    to.link.command(std::move(what));
    to.link.flush(*to.controller);
  }
  void pass_on_speed(const std::vector<ArmId>& together);
  void report(StepId step, Motion& motion);
  void keep_together(Motion& motion);

  CellPtr cell_;
  std::vector<LinkedArm> arms_;               // by ArmId
  std::vector<ArmCommand::SetSpeed> speeds_;  // by ArmId
  Configuration measured_;
  Configuration truth_;
  std::map<StepId, Motion> motions_;
  std::vector<MotionReport> reports_;
};

}  // namespace armloom
