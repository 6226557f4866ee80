#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/executive/job_intake.h"
#include "core/executive/left_touch.h"
#include "core/executive/modules.h"

namespace armloom {

// The actions of jobs with steps: what arms hold, what may touch, inputs and outputs.
class TaskActions : Modules {
 public:
  // `go_on` is called when an action is done later.
  TaskActions(const Modules& modules, std::function<void()> go_on);

  // Does the action. Returns false if it is not done yet.
  Result<bool> act(Task& task, const StepRequest& request);
  // See Executive::detach().
  Result<CollisionObject> detach(const std::string& object);
  // Sets what the task allows to touch.
  void set_touch(Task& task, const TouchOf& next);
  // These arms may have left the objects at which ended steps let them be.
  void clear_left_touch(const std::vector<ArmId>& arms);
  [[nodiscard]] const LeftTouch& touch_left() const { return touch_left_; }
  // Fires the triggers of motions that have come so far.
  void fire_triggers(const MotionReport& report);
  // Returns when the next wait of a step is over; TimePoint::max() if there is none.
  [[nodiscard]] TimePoint wakes_at() const { return wakes_at_; }
  // A wait of a step is over then.
  void wake_at(TimePoint when) { wakes_at_ = std::min(wakes_at_, when); }
  // Returns true if a wait of a step is over.
  [[nodiscard]] bool takes_wake();

 private:
  Result<bool> has_arms_of(Task& task, const std::vector<LinkId>& hands);
  Result<bool> has_arm(Task& task, ArmId arm);
  [[nodiscard]] std::optional<Problem> arm_in_use(ArmId arm, const std::string& object) const;
  bool set_output(Task& task, const std::string& name, const SignalValue& value);
  Result<bool> changed_holding(Task& task, const std::string& object,
                               PlanningScene::Content content);
  [[nodiscard]] std::vector<ArmId> arms_of(const Task& task) const;
  [[nodiscard]] bool moves(const Task& task, ArmId arm) const;
  [[nodiscard]] Touch present_touch(const std::string& object) const;
  void show_touch(const std::string& object);

  std::function<void()> go_on_;
  LeftTouch touch_left_;
  TimePoint wakes_at_ = TimePoint::max();
};

// Goes through the steps of tasks: which step is next, and how a task ends. Motions are jobs of the
// scheduler.
class TaskRun : Modules {
 public:
  TaskRun(const TaskRun&) = delete;  // its actions refer to it
  // `ended` is called when a task has ended and is published.
  TaskRun(const Modules& modules, const JobIntake& intake, std::function<void(JobId)> ended);

  JobView accept_task(PreparedJob prepared);
  void enter_task(PreparedJob prepared, JobId id, JobLabel label, bool is_held_over);
  // Call after each step of the scheduler.
  void go_on_with_tasks();
  void cancel_task(Task& task);
  // See Executive::detach().
  Result<CollisionObject> detach(const std::string& object);
  // Ends the contact that steps allow during this motion if it ends and another job is next on its
  // arms: the motion of that job may be admitted already, and may have no contact. Call before the
  // scheduler has the report.
  void end_contact(const MotionReport& report);
  // A motion of a task has changed.
  void motion_changed(Task& task, JobId motion);
  // The server ends.
  void interrupt(bool keeps_waiting);
  [[nodiscard]] TaskActions& actions() { return actions_; }
  [[nodiscard]] const TaskActions& actions() const { return actions_; }

 private:
  bool go_on(Task& task);
  [[nodiscard]] const Step* lost_motion(const Task& task) const;
  void tell_operator_wait(Task& task, JobId next);
  bool waits_to_retry(Task& task, const std::string& why);
  void end_misfits();
  bool go_on_with_motion(Task& task, TaskStep& present);
  void end_task(Task& task, TaskEnd end);
  void fail_task(Task& task, Reason reason, std::string detail);
  void tell_task(JobId id);
  [[nodiscard]] bool any_stopped(const Task& task) const;
  [[nodiscard]] bool is_recorded(const Task& task);

  const JobIntake& intake_;
  TaskActions actions_;
  std::function<void(JobId)> ended_;
  std::set<JobId> tasks_at_end_;  // their last motion has ended
  bool tasks_are_busy_ = false;   // go_on_with_tasks() runs
};

}  // namespace armloom
