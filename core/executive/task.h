#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/executive/holding.h"
#include "core/executive/task_request.h"
#include "core/jobs/job_words.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// By object: links and objects that it may touch during a motion.
using TouchOf = std::map<std::string, Touch>;

// A step of a task: its request, and how far it is. Each motion is a job of the scheduler (`job`),
// which comes after the job of the motion before it (Submit::task).
struct TaskStep {
  StepRequest request;
  std::optional<JobId> job = {};  // motions
  // Submit::awaits_actions of a motion: actions, a change of `touch` or the gripper's position come
  // first.
  bool is_awaited = false;
  TouchOf touch = {};              // motions
  std::size_t triggers_fired = 0;  // motions
  int retried = 0;
};

// How a task ended.
struct TaskEnd {
  JobState state;  // terminal
  Reason reason;
  std::string detail;
  TimePoint at;
};

// A job with several steps. Its id, and the key that clients know, are those of its first motion.
struct Task {
  JobId id{0};
  std::vector<TaskStep> steps;
  std::size_t at = 0;                      // the present step
  std::optional<TimePoint> began_at = {};  // of the first action or motion
  // The present action has begun; or the present step is tried again then.
  std::optional<TimePoint> since = {};
  std::vector<Wait> waits_on = {};  // of the present action
  TouchOf touch = {};               // what objects may touch at present
  bool awaits_record = false;       // StartLog::has_moved; ...
  bool is_present_done = false;     // ... then the present step ends
  // Why the steps to come do not fit what the arms hold; the task fails when it does not move.
  std::optional<std::string> misfit = {};
  std::optional<TaskEnd> end = {};

  [[nodiscard]] const TaskStep* present() const { return at < steps.size() ? &steps[at] : nullptr; }
  // Returns the job of the present motion, or of the next one; nullopt after the last one.
  [[nodiscard]] std::optional<JobId> next_motion() const;
  [[nodiscard]] std::vector<JobId> motions() const;
  // Returns the index of the first step to come: the present one unless it is done.
  [[nodiscard]] std::size_t first_to_come() const { return at + (is_present_done ? 1 : 0); }
  [[nodiscard]] std::vector<StepRequest> to_come() const;
};

// Returns the state of the task, as clients see it: `paused` if it has begun and its present step
// waits.
[[nodiscard]] JobState state_of(const Task& task, const Scheduler& scheduler);

// The tasks that have not been forgotten. Used on the strand.
class TaskBook {
 public:
  Task& add(Task task);
  [[nodiscard]] bool empty() const { return tasks_.empty(); }
  // Returns the task of which the job is a motion; null if it is a job of its own.
  [[nodiscard]] const Task* find(JobId motion) const;
  [[nodiscard]] Task* find(JobId motion);
  // Returns the job that clients know: the first motion of the task, or the job itself.
  [[nodiscard]] JobId told(JobId job) const;
  // Returns the present or next motion of a task, or its last one; or the job itself.
  [[nodiscard]] JobId present_motion(JobId job) const;
  // Names the job of a motion.
  void set_motion(Task& task, std::size_t step, JobId motion);
  void forget(JobId id);
  // Tasks that have not ended, ascending.
  [[nodiscard]] std::vector<JobId> active() const;
  // Tasks that have begun and not ended.
  [[nodiscard]] std::vector<Task*> begun();
  // Changes what hands hold as the steps to come of all tasks do.
  void change_holding(const Cell& cell, HandsOf& hands) const;

 private:
  std::map<JobId, Task> tasks_;          // by id
  std::map<JobId, JobId> id_of_motion_;  // Task::id, by motion
};

// Change what hands hold as the steps do. Precondition: their links are known.
void change_holding(const Cell& cell, const StepRequest& step, HandsOf& hands);
void change_holding(const Cell& cell, std::span<const StepRequest> steps, HandsOf& hands);

// Returns the hands that let go by this step.
[[nodiscard]] std::vector<LinkId> leaving(const Cell& cell, const DetachRequest& detach,
                                          const HandsOf& hands);

// Links and objects by their names. A name that is no link is an object.
[[nodiscard]] Touch touch_of(const Cell& cell, const std::vector<std::string>& names);
// Returns what objects may touch during each step, by index; empty for actions. The hand may touch
// the object during the last motion before it is attached, and during the first motion after it is
// detached; `touch` applies to the motions before and after. The gripper's steps next to these
// belong to them. `hands`: hands that hold objects before the first step. Precondition: the links
// of all steps are known.
[[nodiscard]] std::vector<TouchOf> touch_during(const Cell& cell,
                                                const std::vector<StepRequest>& steps,
                                                HandsOf hands);

}  // namespace armloom
