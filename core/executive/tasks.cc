// Advances jobs with several steps. Their motions are jobs of the scheduler.
#include <algorithm>
#include <set>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/gripper_goal.h"
#include "core/executive/task_intake.h"
#include "core/executive/task_run.h"
#include "core/executive/task_view.h"
#include "core/jobs/standing.h"
#include "core/jobs/waits.h"

namespace armloom {
namespace {

std::string step_text(const Task& task, std::size_t i) {
  std::string text = "step " + std::to_string(i + 1) + " of " + std::to_string(task.steps.size());
  const TaskStep& step = task.steps[i];
  if (!step.request.name.empty()) text += " (" + step.request.name + ")";
  return text + ": ";
}

std::string step_text(const Task& task) { return step_text(task, task.at); }

std::string text_of(const Problems& problems) {
  const Problem& first = problems.front();
  return first.detail;
}

// Returns the end of a task whose motion has not succeeded.
TaskEnd end_of(const Task& task, const Step& motion, const JobView& view, TimePoint now) {
  std::string detail = view.detail();
  const auto is_motion = [&](const TaskStep& step) { return step.job == motion.id.job; };
  const auto i = std::ranges::find_if(task.steps, is_motion) - task.steps.begin();
  if (!detail.empty()) detail = step_text(task, static_cast<std::size_t>(i)) + detail;
  return {motion.state(), motion.reason().value_or(Reason::step_failed), std::move(detail), now};
}

}  // namespace

TaskRun::TaskRun(const Modules& modules, const JobIntake& intake, std::function<void(JobId)> ended)
    : Modules(modules),
      intake_(intake),
      actions_(modules, [this] { go_on_with_tasks(); }),
      ended_(std::move(ended)) {}

JobView TaskRun::accept_task(PreparedJob prepared) {
  const JobId id = scheduler_.next_job();
  JobLabel label{prepared.key, prepared.name};
  if (label.key.empty()) label.key = jobs_.free_key(id);
  enter_task(std::move(prepared), id, std::move(label), false);
  return publisher_.view(id);
}

void TaskRun::enter_task(PreparedJob prepared, JobId id, JobLabel label, bool is_held_over) {
  label.bytes = prepared.bytes();
  jobs_.add(id, std::move(label));
  Task made{.id = id, .steps = {}};
  for (const auto& step : prepared.steps) made.steps.push_back(step.step);
  Task& task = tasks_.add(std::move(made));
  std::optional<JobId> before;
  const bool was_busy = std::exchange(tasks_are_busy_, true);
  for (std::size_t i = 0; i < prepared.steps.size() && !task.end; ++i) {
    if (!prepared.steps[i].motion) continue;
    Submit submitted = intake_.submission(prepared, std::move(*prepared.steps[i].motion), before);
    submitted.job = before ? scheduler_.next_job() : id;
    submitted.task = id;
    submitted.awaits_actions = task.steps[i].is_awaited;
    submitted.retries = task.steps[i].request.retry;
    submitted.is_held_over = is_held_over;
    submitted.start_is_recorded = !before && execution_.starts().has_log();
    tasks_.set_motion(task, i, submitted.job);
    before = submitted.job;
    step(submitted);
  }
  tasks_are_busy_ = was_busy;
  go_on_with_tasks();
}

// Goes on with each task that has its turn: the first of the queue of an arm, or one whose last
// motion has ended.
void TaskRun::go_on_with_tasks() {
  if (tasks_.empty() || tasks_are_busy_) return;
  tasks_are_busy_ = true;
  std::set<JobId> told;
  for (bool again = true; again;) {
    again = false;
    std::vector<JobId> all(tasks_at_end_.begin(), tasks_at_end_.end());
    for (const ArmId arm : all_arms(*cell_)) {
      if (const auto head = scheduler_.head(arm)) all.push_back(*head);
    }
    for (const JobId job : all) {
      // A task that has ended may be forgotten at once.
      for (Task* task = tasks_.find(job); task != nullptr && go_on(*task);
           task = tasks_.find(job)) {
        again = told.insert(tasks_.told(job)).second || again;
      }
    }
  }
  tasks_are_busy_ = false;
  for (const JobId id : told) {
    const Task* task = tasks_.find(id);
    if (task != nullptr && !task->end) tell_task(id);
  }
}

// Returns true if the task has advanced.
bool TaskRun::go_on(Task& task) {
  if (task.end || task.awaits_record) return false;
  if (std::exchange(task.is_present_done, false)) {
    task.since.reset();
    ++task.at;
    return true;
  }
  if (task.at == task.steps.size()) {
    end_task(task, {JobState::succeeded, Reason::completed, "", clock_.now});
    return true;
  }
  TaskStep& present = task.steps[task.at];
  const Step* lost = lost_motion(task);
  if (lost != nullptr && !(present.job && scheduler_.find(*present.job)->has_authority())) {
    end_task(task, end_of(task, *lost, view_of(*lost, *cell_, jobs_), clock_.now));
    return true;
  }
  const bool is_moving = present.job && scheduler_.find(*present.job)->has_authority();
  if (task.misfit && !is_moving) {
    fail_task(task, Reason::step_failed, *task.misfit);
    return true;
  }
  if (task.since && clock_.now < *task.since) {
    actions_.wake_at(*task.since);
    return false;
  }
  if (present.job) return go_on_with_motion(task, present);
  const auto next = task.next_motion();
  if (next && !scheduler_.has_turn_for_actions(*next)) {
    tell_operator_wait(task, *next);
    return false;
  }
  if (!next && any_stopped(task)) return false;
  if (!is_recorded(task)) return false;
  if (!task.began_at) task.began_at = clock_.now;
  const std::vector<Wait> waited = std::exchange(task.waits_on, {});
  if (!task.since) task.since = clock_.now;
  const auto done = actions_.act(task, present.request);
  if (!done) {
    if (waits_to_retry(task, text_of(done.error()))) return false;
    fail_task(task, Reason::step_failed, step_text(task) + text_of(done.error()));
    return true;
  }
  if (!*done) {
    const bool is_news = task.waits_on.size() != waited.size() ||
                         (!waited.empty() && !task.waits_on.front().same_cause(waited.front()));
    if (is_news) tell_task(task.id);
    return false;
  }
  task.is_present_done = task.awaits_record;
  if (task.is_present_done) return false;
  task.since.reset();
  ++task.at;
  return true;
}

// Returns false if the present step, which has failed, is not to be tried again.
bool TaskRun::waits_to_retry(Task& task, const std::string& why) {
  TaskStep& step = task.steps[task.at];
  if (step.retried >= step.request.retry) return false;
  ++step.retried;
  task.since = clock_.now + kRetryPause;
  actions_.wake_at(*task.since);
  task.waits_on = {{.kind = Wait::Kind::action,
                    .detail = "retry " + std::to_string(step.retried) + " of " +
                              std::to_string(step.request.retry) + " begins in " +
                              seconds_text(kRetryPause) + ": " + why}};
  tell_task(task.id);
  return true;
}

// Returns the first remaining motion that has ended without success. If it was still to come, it
// was in a deadlock.
const Step* TaskRun::lost_motion(const Task& task) const {
  for (std::size_t i = task.at; i < task.steps.size(); ++i) {
    const auto& motion = task.steps[i].job;
    const Step* step = motion ? scheduler_.find(*motion) : nullptr;
    if (step != nullptr && step->has_ended() && step->state() != JobState::succeeded) return step;
  }
  return nullptr;
}

// Publishes that the task waits for an operator, if its next motion would: its actions wait too.
void TaskRun::tell_operator_wait(Task& task, JobId next) {
  if (!task.began_at) return;  // the motion says so itself
  auto wait = operator_wait(scheduler_.state(), *scheduler_.find(next));
  if (!wait || (task.waits_on.size() == 1 && task.waits_on.front().same_cause(*wait))) return;
  task.waits_on = {*std::move(wait)};
  tell_task(task.id);
}

bool TaskRun::go_on_with_motion(Task& task, TaskStep& present) {
  const Step& motion = *scheduler_.find(*present.job);
  if (motion.has_ended()) {
    if (motion.state() == JobState::succeeded) {
      task.since.reset();
      ++task.at;
      return true;
    }
    end_task(task, end_of(task, motion, view_of(motion, *cell_, jobs_), clock_.now));
    return true;
  }
  if (!motion.job->awaits_actions) return false;
  if (present.retried < present.request.retry - motion.job->retries) {
    (void)waits_to_retry(task, motion.goal->way().refusal.value_or(""));
    return false;
  }
  if (!task.waits_on.empty()) {
    task.waits_on.clear();
    tell_task(task.id);
  }
  if (!scheduler_.has_turn_for_actions(*present.job) || !is_recorded(task)) return false;
  TrajectoryPtr way;
  if (const auto* gripper = std::get_if<GripperStepRequest>(&present.request.what)) {
    auto made = gripper_motion(*gripper, *cell_, scheduler_.state().arms.rest());
    if (!made) {
      fail_task(task, Reason::step_failed, step_text(task) + text_of(made.error()));
      return true;
    }
    way = *std::move(made);
  }
  actions_.set_touch(task, present.touch);
  step(ActionsDone{*present.job, std::move(way)});
  return true;
}

void TaskRun::tell_task(JobId id) { publisher_.tell_job(publisher_.view(id), clock_.now); }

void TaskRun::motion_changed(Task& task, JobId motion) {
  const Step& step = *scheduler_.find(motion);
  if (step.times.started_at && !task.began_at) task.began_at = step.times.started_at;
  if (task.end) return;
  const bool is_early = step.has_ended() && step.state() != JobState::succeeded;
  if (is_early || (step.has_ended() && motion == task.motions().back())) {
    tasks_at_end_.insert(task.id);
  }
  if (step.has_ended()) return;  // go_on_with_tasks() sees it
  if (task.next_motion() == motion) tell_task(task.id);
}

bool TaskRun::any_stopped(const Task& task) const {
  const auto& arms = scheduler_.find(task.motions().back())->trajectory->arms();
  return std::ranges::any_of(arms, [&](ArmId arm) { return scheduler_.stopped(arm); });
}

// The first action waits until the start is on disk, so that a restart does nothing twice.
bool TaskRun::is_recorded(const Task& task) {
  if (task.began_at) return true;
  const auto written = [this](JobId id) {
    clock_.note({ExecutiveInput::StartWritten{only_step(id)}});
    step(StartRecorded{only_step(id)});
    go_on_with_tasks();
  };
  return execution_.record_start(task.id, written);
}

// A task that has begun is interrupted at its present step, even if the next motion has not begun.
void TaskRun::interrupt(bool keeps_waiting) {
  const bool was_busy = std::exchange(tasks_are_busy_, true);
  for (Task* task : tasks_.begun()) {
    TaskEnd end{JobState::interrupted, Reason::server_restart,
                step_text(*task) + "the server ended while the job was under way", clock_.now};
    end_task(*task, std::move(end));
  }
  step(Interrupt{keeps_waiting});
  tasks_are_busy_ = was_busy;
}

}  // namespace armloom
