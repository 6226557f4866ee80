#include "core/executive/task.h"

#include <algorithm>

namespace armloom {
namespace {

void add(TouchOf& of, const std::string& object, const Touch& touch) {
  Touch& all = of[object];
  all.links.insert(all.links.end(), touch.links.begin(), touch.links.end());
  all.objects.insert(all.objects.end(), touch.objects.begin(), touch.objects.end());
}

bool is_gripper(const StepRequest& step) {
  return std::holds_alternative<GripperStepRequest>(step.what);
}

}  // namespace

const char* kind_of(const StepRequest& step) {
  if (const auto* motion = std::get_if<MotionStepRequest>(&step.what)) {
    return motion->move_to ? "move_to" : "trajectory";
  }
  constexpr const char* kinds[] = {"trajectory", "gripper", "attach", "detach",
                                   "wait_s",     "set_io",  "wait_io"};
  return kinds[step.what.index()];
}

std::optional<JobId> Task::next_motion() const {
  for (std::size_t i = at; i < steps.size(); ++i) {
    if (steps[i].job) return steps[i].job;
  }
  return std::nullopt;
}

std::vector<JobId> Task::motions() const {
  std::vector<JobId> all;
  for (const TaskStep& step : steps) {
    if (step.job) all.push_back(*step.job);
  }
  return all;
}

std::vector<StepRequest> Task::to_come() const {
  std::vector<StepRequest> requests;
  for (std::size_t i = first_to_come(); i < steps.size(); ++i) {
    requests.push_back(steps[i].request);
  }
  return requests;
}

void change_holding(const Cell& cell, const StepRequest& step, HandsOf& hands) {
  if (const auto* attach = std::get_if<AttachRequest>(&step.what)) {
    if (!attach->shared) hands.erase(attach->object);
    hands[attach->object].push_back(*cell.find_link(attach->link));
  } else if (const auto* detach = std::get_if<DetachRequest>(&step.what)) {
    const auto held = hands.find(detach->object);
    if (held == hands.end()) return;
    for (const LinkId link : leaving(cell, *detach, hands)) std::erase(held->second, link);
    if (held->second.empty()) hands.erase(held);
  }
}

void change_holding(const Cell& cell, std::span<const StepRequest> steps, HandsOf& hands) {
  for (const StepRequest& step : steps) change_holding(cell, step, hands);
}

std::vector<LinkId> leaving(const Cell& cell, const DetachRequest& detach, const HandsOf& hands) {
  if (const auto link = cell.find_link(detach.link)) return {*link};
  const auto all = hands.find(detach.object);
  return all == hands.end() ? std::vector<LinkId>{} : all->second;
}

JobState state_of(const Task& task, const Scheduler& scheduler) {
  if (task.end) return task.end->state;
  const auto motion = task.next_motion();
  const TaskStep* present = task.present();
  const bool acts = present == nullptr || (!present->job && task.since);
  if (acts && task.began_at) return task.waits_on.empty() ? JobState::running : JobState::paused;
  const Step& step = *scheduler.find(*motion);
  const JobState state = step.pausing() ? JobState::paused : step.state();
  if (is_terminal(state))
    return task.began_at ? JobState::running : JobState::queued;  // until seen
  if (!task.began_at || state == JobState::running || state == JobState::paused) return state;
  return step.waits_on.empty() ? JobState::running : JobState::paused;
}

Task& TaskBook::add(Task task) {
  const JobId id = task.id;
  return tasks_.emplace(id, std::move(task)).first->second;
}

const Task* TaskBook::find(JobId motion) const {
  const auto id = id_of_motion_.find(motion);
  return id == id_of_motion_.end() ? nullptr : &tasks_.at(id->second);
}

Task* TaskBook::find(JobId motion) {
  const auto id = id_of_motion_.find(motion);
  return id == id_of_motion_.end() ? nullptr : &tasks_.at(id->second);
}

JobId TaskBook::told(JobId job) const {
  const auto id = id_of_motion_.find(job);
  return id == id_of_motion_.end() ? job : id->second;
}

JobId TaskBook::present_motion(JobId job) const {
  const Task* task = find(job);
  return task == nullptr ? job : task->next_motion().value_or(task->motions().back());
}

void TaskBook::set_motion(Task& task, std::size_t step, JobId motion) {
  task.steps[step].job = motion;
  id_of_motion_.emplace(motion, task.id);
}

void TaskBook::forget(JobId id) {
  const auto task = tasks_.find(id);
  if (task == tasks_.end()) return;
  for (const JobId motion : task->second.motions()) id_of_motion_.erase(motion);
  tasks_.erase(task);
}

std::vector<JobId> TaskBook::active() const {
  std::vector<JobId> ids;
  for (const auto& [id, task] : tasks_) {
    if (!task.end) ids.push_back(id);
  }
  return ids;
}

std::vector<Task*> TaskBook::begun() {
  std::vector<Task*> found;
  for (auto& [id, task] : tasks_) {
    if (task.began_at && !task.end) found.push_back(&task);
  }
  return found;
}

void TaskBook::change_holding(const Cell& cell, HandsOf& hands) const {
  for (const auto& [id, task] : tasks_) {
    for (std::size_t i = task.first_to_come(); !task.end && i < task.steps.size(); ++i) {
      armloom::change_holding(cell, task.steps[i].request, hands);
    }
  }
}

Touch touch_of(const Cell& cell, const std::vector<std::string>& names) {
  Touch touch;
  for (const std::string& name : names) {
    if (const auto link = cell.find_link(name)) {
      touch.links.push_back(*link);
    } else {
      touch.objects.push_back(name);
    }
  }
  return touch;
}

std::vector<TouchOf> touch_during(const Cell& cell, const std::vector<StepRequest>& steps,
                                  HandsOf hands) {
  std::vector<TouchOf> during(steps.size());
  // Adds the touch to the motion next to step `i` in this direction, and to gripper steps before
  // it.
  const auto next_to = [&](std::size_t i, int direction, const std::string& object,
                           const Touch& touch) {
    for (auto k = static_cast<std::ptrdiff_t>(i) + direction;
         k >= 0 && k < static_cast<std::ptrdiff_t>(steps.size()); k += direction) {
      const auto at = static_cast<std::size_t>(k);
      if (!steps[at].is_motion()) continue;
      add(during[at], object, touch);
      if (!is_gripper(steps[at])) return;
    }
  };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (const auto* attach = std::get_if<AttachRequest>(&steps[i].what)) {
      const Touch touch = touch_of(cell, attach->touch);
      Touch hand{links_of_hand(cell, *cell.find_link(attach->link))};
      hand.links.insert(hand.links.end(), touch.links.begin(), touch.links.end());
      // Another hand may hold it until then.
      next_to(i, -1, attach->object, hand);
      next_to(i, +1, attach->object, touch);
      const auto before = hands.find(attach->object);
      if (before != hands.end() && !attach->shared) {
        for (const LinkId link : before->second) {
          next_to(i, +1, attach->object, {links_of_hand(cell, link)});
        }
      }
    } else if (const auto* detach = std::get_if<DetachRequest>(&steps[i].what)) {
      const Touch touch = touch_of(cell, detach->touch);
      next_to(i, -1, detach->object, touch);
      Touch hand{touch.links};
      for (const LinkId link : leaving(cell, *detach, hands)) {
        const auto links = links_of_hand(cell, link);
        hand.links.insert(hand.links.end(), links.begin(), links.end());
      }
      next_to(i, +1, detach->object, hand);
    }
    change_holding(cell, steps[i], hands);
  }
  return during;
}

}  // namespace armloom
