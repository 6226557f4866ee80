#include "core/executive/task_view.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "core/executive/arms_of.h"

namespace armloom {
namespace {

std::string text(const MotionStepRequest& motion) {
  return motion.move_to && motion.move_to->named ? "to " + *motion.move_to->named : "";
}
std::string text(const GripperStepRequest& gripper) {
  char width[64];
  std::snprintf(width, sizeof width, ": %.6g m", gripper.width_m);
  return gripper.arm + width;
}
std::string text(const AttachRequest& attach) {
  return attach.object + " to " + attach.link + (attach.shared ? " too" : "");
}
std::string text(const DetachRequest& detach) {
  return detach.object + (detach.link.empty() ? "" : " from " + detach.link);
}
std::string text(const WaitRequest& wait) {
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.6g s", to_seconds(wait.time));
  return seconds;
}
std::string text(const SetIoRequest& io) { return io.signal + " = " + text_of(io.value); }
std::string text(const WaitIoRequest& io) { return io.signal + " = " + text_of(io.value); }

StepState state_of(const Task& task, std::size_t i, const Step* motion) {
  if (i < task.at) return StepState::done;
  if (i > task.at) return StepState::waiting;
  if (task.end) {
    return task.end->state == JobState::succeeded ? StepState::done : StepState::failed;
  }
  if (motion != nullptr) {
    return motion->times.started_at ? StepState::running : StepState::waiting;
  }
  return task.since ? StepState::running : StepState::waiting;
}

StepView view_of_step(const Task& task, std::size_t i, const Scheduler& scheduler,
                      const Cell& cell) {
  const TaskStep& step = task.steps[i];
  const Step* motion = step.job ? scheduler.find(*step.job) : nullptr;
  StepView view{.name = step.request.name,
                .kind = kind_of(step.request),
                .state = state_of(task, i, motion),
                .detail = text_of(step.request),
                .arms = {}};
  if (motion == nullptr) return view;
  view.arms = each_name(cell, motion->trajectory->arms());
  view.progress = to_seconds(motion->progress) / to_seconds(motion->trajectory->duration());
  return view;
}

// Joins the motions; each one is weighted by its duration.
JobMotionView motion_of(const Task& task, const Scheduler& scheduler, const JobView& present) {
  JobMotionView all = present.motion;
  all.duration = Duration{};
  all.planned.reset();
  all.velocity_scaling.reset();
  double done_s = 0.0;
  for (const JobId motion : task.motions()) {
    const Step* step = scheduler.find(motion);
    if (step == nullptr) continue;
    all.duration += step->trajectory->duration();
    done_s += to_seconds(step->progress);
    if (step->goal) all.planned = all.planned.value_or(true) && !step->is_unplanned();
  }
  all.progress = all.duration > Duration{} ? done_s / to_seconds(all.duration) : 0.0;
  return all;
}

}  // namespace

std::string text_of(const StepRequest& step) {
  return std::visit([](const auto& what) { return text(what); }, step.what);
}

JobView view_of(const Task& task, const Scheduler& scheduler, const Cell& cell,
                const JobNames& names) {
  const std::vector<JobId> motions = task.motions();
  const JobId shown = task.next_motion().value_or(motions.back());
  const Step& first = *scheduler.find(task.id);
  JobView view = view_of(*scheduler.find(shown), cell, names);
  view.id = task.id;
  view.terms.start_when = first.job->terms.start_when;
  view.terms.move_to_start = first.job->terms.move_to_start;
  view.state = state_of(task, scheduler);
  view.motion = motion_of(task, scheduler, view);
  view.times.submitted_at = first.job->submitted_at;
  view.times.scheduled_at = view_of(first, cell, names).times.scheduled_at;
  view.times.started_at = task.began_at;
  view.times.ended_at.reset();
  view.arms.clear();
  for (std::size_t i = 0; i < task.steps.size(); ++i) {
    StepView step = view_of_step(task, i, scheduler, cell);
    for (const std::string& arm : step.arms) {
      if (std::ranges::count(view.arms, arm) == 0) view.arms.push_back(arm);
    }
    view.steps.push_back(std::move(step));
  }
  if (task.at < task.steps.size()) view.step = task.at;
  const TaskStep* present = task.present();
  const bool acts = present != nullptr && !present->job && task.since;
  const bool is_retried = present != nullptr && present->job && !task.waits_on.empty();
  if (present == nullptr || acts || is_retried) view.waits_on.clear();
  if (present != nullptr && !present->job) {  // until then, the task waits for what its motion does
    std::erase_if(view.waits_on, [](const WaitView& w) { return w.kind == Wait::Kind::action; });
  }
  for (const Wait& wait : task.waits_on) view.waits_on.push_back(view_of(wait, cell, names));
  view.result.reset();
  if (!task.end) return view;
  view.waits_on.clear();
  view.times.ended_at = task.end->at;
  view.result = JobResultView{task.end->reason, task.end->detail, {}};
  if (task.end->state != JobState::succeeded) view.result->step = task.at;
  return view;
}

}  // namespace armloom
