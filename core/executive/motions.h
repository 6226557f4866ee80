#pragma once

#include <map>
#include <memory>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/coordination/in_step.h"
#include "core/jobs/inputs.h"
#include "core/model/cell.h"

namespace armloom {

// The arms and the motions on them: hands a job's trajectory to the controllers of its arms
// and joins what they say into one report for the job (one progress, that of the last; one end).
// Siblings of an arm that faults are braked; siblings that get ahead of it by more than kOutOfStep
// wait on the path. No arm is given authority farther ahead of the last position that is known of
// its siblings than kOutOfStep and the motion's stopping reach: so they keep together also while
// the feedback of one of them does not come.
class Motions {
 public:
  Motions(CellPtr cell, std::vector<std::unique_ptr<ArmController>> controllers,
          Configuration measured);

  void dispatch(const Dispatch& dispatch, const TrajectoryPtr& trajectory);
  void grant(const Grant& grant);
  void brake(JobId job);
  void brake_all();  // whatever moves
  void release(JobId job);

  // One control cycle of every arm. Returns what there is to tell the scheduler, in order of jobs.
  [[nodiscard]] const std::vector<MotionReport>& tick(TimePoint now);
  // The arms' own part of it: what goes on if nobody asks any more.
  void tick_arms(TimePoint now);

  // As of the last tick; whole cell.
  [[nodiscard]] const Configuration& measured() const { return measured_; }
  [[nodiscard]] const ArmFeedback& feedback(ArmId arm) const { return feedback_[arm.index()]; }
  [[nodiscard]] bool moving(ArmId arm) const;
  // It got ahead on its path in the last tick: a pause on the way is none.
  [[nodiscard]] bool advances(ArmId arm) const { return advances_[arm.index()]; }
  // No arm moves, as of the last tick.
  [[nodiscard]] bool all_at_rest() const;
  // Nor will one before the next command.
  [[nodiscard]] bool all_settled() const;
  // Largest distance of a measured joint from where its path is at the measured progress, rad or
  // m; zero without a motion.
  [[nodiscard]] double deviation(ArmId arm) const;
  // What each arm that has a motion may do of it, in the order of jobs. Trajectory time.
  struct UnderWay {
    ArmId arm;
    JobId job;
    Duration progress;  // measured
    Duration authority;
  };
  [[nodiscard]] std::vector<UnderWay> under_way() const;

 private:
  struct Motion {
    TrajectoryPtr trajectory;
    std::map<ArmId, Duration>
        stands_at{};  // measured, where an arm rests on the path after a brake
    Duration authority{};
    Duration ahead_max{};  // of a sibling; motions of several arms
    Duration handed_on{};  // of the authority, to the controllers
    bool resting = false;  // its end has been reported
    bool braking = false;
  };
  void report(JobId job, Motion& motion);
  void keep_together(Motion& motion);

  CellPtr cell_;
  std::vector<std::unique_ptr<ArmController>> controllers_;  // ArmId
  std::vector<ArmFeedback> feedback_;                        // ArmId
  std::vector<bool> advances_;                               // ArmId
  Configuration measured_;
  std::map<JobId, Motion> motions_;
  std::vector<MotionReport> reports_;
};

}  // namespace armloom
