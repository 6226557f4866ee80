// Ends jobs with steps: by success, failure or cancel, or because holdings have changed.
#include <algorithm>
#include <utility>

#include "core/executive/task_intake.h"
#include "core/executive/task_run.h"

namespace armloom {

// The task has ended. Its motions that have not begun end with it.
void TaskRun::end_task(Task& task, TaskEnd end) {
  if (task.end) return;
  task.end = std::move(end);
  task.waits_on.clear();
  tasks_at_end_.erase(task.id);
  if (task.end->state != JobState::succeeded) end_misfits();
  for (const JobId motion : task.motions()) {
    const Step* step = scheduler_.find(motion);
    if (step != nullptr && !step->has_ended()) this->step(Cancel{motion});
  }
  actions_.set_touch(task, {});
  tell_task(task.id);
  ended_(task.id);
}

// Finds the tasks whose steps do not fit what the arms hold, because a job before them has ended
// early, or an operator has let an object go. They fail before they act.
void TaskRun::end_misfits() {
  PresentObjects present = present_objects(*scene_.scene());
  for (const JobId id : tasks_.active()) {
    Task* task = tasks_.find(id);
    if (task == nullptr || task->end) continue;
    const std::vector<StepRequest> steps = task->to_come();
    const auto misfit = find_misfit(*cell_, steps, present);
    const TaskStep* present_step = task->present();
    // An action that is tried again may fit later.
    const bool is_retried = task->began_at && present_step != nullptr && !present_step->job &&
                            present_step->retried < present_step->request.retry;
    if (!misfit || is_retried) {
      change_holding(*cell_, steps, present.hands);
      continue;
    }
    task->misfit = "what the arms hold has changed since the job was accepted: " + *misfit;
    const auto next = task->next_motion();
    const bool is_moving = next && scheduler_.find(*next)->has_authority();
    if (!is_moving) return fail_task(*task, Reason::step_failed, *task->misfit);  // and looks again
  }
}

Result<CollisionObject> TaskRun::detach(const std::string& object) {
  auto placed = actions_.detach(object);
  if (placed) end_misfits();
  return placed;
}

void TaskRun::fail_task(Task& task, Reason reason, std::string detail) {
  end_task(task, {JobState::failed, reason, std::move(detail), clock_.now});
}

void TaskRun::cancel_task(Task& task) {
  const auto next = task.next_motion();
  const Step* motion = next ? scheduler_.find(*next) : nullptr;
  const bool is_moving = motion != nullptr && motion->has_authority();
  if (is_moving) return step(Cancel{*next});  // it ends when its arm rests
  end_task(task, {JobState::canceled, Reason::canceled_by_client,
                  task.began_at ? "canceled between its motions" : "canceled before it moved",
                  clock_.now});
}

void TaskRun::end_contact(const MotionReport& report) {
  if (report.kind == MotionReport::Kind::progressed) return;
  Task* task = tasks_.find(report.step.job);
  const Step* motion = scheduler_.find(report.step.job);
  if (task == nullptr || task->end || task->touch.empty() || motion == nullptr) return;
  const auto* braking = motion->in<Braking>();
  const bool is_at_end =
      report.kind != MotionReport::Kind::stopped || (braking != nullptr && braking->after.ends());
  const auto is_followed = [&](ArmId arm) {
    const auto next = scheduler_.state().jobs.queues().behind(*motion, arm);
    return next && tasks_.told(next->job) != task->id;
  };
  const auto& arms = motion->trajectory->arms();
  if (is_at_end && std::ranges::any_of(arms, is_followed)) actions_.set_touch(*task, {});
}

}  // namespace armloom
