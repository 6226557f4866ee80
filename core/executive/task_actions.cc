// Executes the actions of jobs with steps: attach and detach, touch, inputs and outputs.
#include <algorithm>
#include <span>
#include <utility>

#include "core/executive/task_run.h"
#include "core/executive/task_view.h"
#include "core/jobs/waits.h"

namespace armloom {

TaskActions::TaskActions(const Modules& modules, std::function<void()> go_on)
    : Modules(modules), go_on_(std::move(go_on)) {}

bool TaskActions::takes_wake() {
  if (clock_.now < wakes_at_) return false;
  wakes_at_ = TimePoint::max();
  return true;
}

Result<bool> TaskActions::act(Task& task, const StepRequest& request) {
  if (const auto* attach = std::get_if<AttachRequest>(&request.what)) {
    const LinkId link = *cell_->find_link(attach->link);
    std::vector<LinkId> hands = hands_at(*scene_.scene(), attach->object);
    hands.insert(hands.begin(), link);
    const auto has_arms = has_arms_of(task, hands);
    if (!has_arms || !*has_arms) return has_arms;
    auto content = attached(*scene_.scene(), execution_.motions().measured(), attach->object, link,
                            touch_of(*cell_, attach->touch), attach->shared);
    if (!content) return failure(std::move(content.error()));
    return changed_holding(task, attach->object, std::move(*content));
  }
  if (const auto* detach = std::get_if<DetachRequest>(&request.what)) {
    const auto has_arms = has_arms_of(task, hands_at(*scene_.scene(), detach->object));
    if (!has_arms || !*has_arms) return has_arms;
    auto content = detached(*scene_.scene(), execution_.motions().measured(), detach->object,
                            cell_->find_link(detach->link));
    if (!content) return failure(std::move(content.error()));
    return changed_holding(task, detach->object, std::move(*content));
  }
  if (const auto* wait = std::get_if<WaitRequest>(&request.what)) {
    const TimePoint until = *task.since + wait->time;
    if (clock_.now >= until) return true;
    wake_at(until);
    task.waits_on = {{.kind = Wait::Kind::action, .detail = "waits " + armloom::text_of(request)}};
    return false;
  }
  if (const auto* io = std::get_if<SetIoRequest>(&request.what)) {
    return set_output(task, io->signal, io->value);
  }
  const auto& io = std::get<WaitIoRequest>(request.what);
  const SignalView& signal = signals_.views()[cell_->io.find_signal(io.signal)->index()];
  if (signal.value == io.value) return true;
  const std::string now = signal.value ? text_of(*signal.value) : "not known: " + signal.detail;
  if (io.timeout) {
    const TimePoint until = *task.since + *io.timeout;
    if (clock_.now >= until) {
      return failure(Problem{ProblemKind::conflict, "timeout", "/wait_io/timeout_s",
                             io.signal + " was not " + text_of(io.value) + " within " +
                                 seconds_text(*io.timeout) + "; it is " + now,
                             now});
    }
    wake_at(until);
  }
  task.waits_on = {
      {.kind = Wait::Kind::io,
       .detail = io.signal + " is " + now + "; the step waits for " + text_of(io.value),
       .signal = io.signal}};
  return false;
}

Result<bool> TaskActions::has_arms_of(Task& task, const std::vector<LinkId>& hands) {
  for (const LinkId hand : hands) {
    const auto has_it = has_arm(task, *cell_->link(hand).arm);
    if (!has_it || !*has_it) return has_it;
  }
  return true;
}

// Returns true if no other job moves the arm. Otherwise the task waits for that. It fails if it
// does not move this arm, or if it would wait for a job that may wait for this task.
Result<bool> TaskActions::has_arm(Task& task, ArmId arm) {
  const std::string& name = cell_->arm(arm).name;
  if (!moves(task, arm)) {
    return failure(Problem{ProblemKind::conflict, "held-by-another-arm", "",
                           "arm " + name + " holds the object, and no step of this job moves " +
                               name + ": let a job of " + name +
                               " detach it, and submit this job with \"after\": that job"});
  }
  const auto head = scheduler_.head(arm);
  const bool has_other = head && tasks_.told(*head) != task.id;
  if (!has_other && !scheduler_.stopped(arm) && !execution_.motions().moving(arm)) return true;
  const auto moves_it = [&](const TaskStep& step) {
    if (!step.job) return false;
    const auto& arms = scheduler_.find(*step.job)->trajectory->arms();
    return std::ranges::find(arms, arm) != arms.end();
  };
  const auto to_come = std::span(task.steps).subspan(task.at);
  if (has_other && std::ranges::none_of(to_come, moves_it)) {
    return failure(Problem{ProblemKind::conflict, "arm-in-use", "",
                           "arm " + name + " has another job: add a motion of " + name +
                               " after this step, so that the job keeps the arm until then"});
  }
  const auto& timeout = scheduler_.find(task.id)->job->terms.backlog_timeout;
  if (has_other && timeout) {  // the scheduler does not know of this wait
    if (clock_.now >= *task.since + *timeout) {
      return failure(Problem{ProblemKind::conflict, "arm-in-use", "",
                             "arm " + name + " had another job for " + seconds_text(*timeout) +
                                 " (backlog_timeout_s)"});
    }
    wake_at(*task.since + *timeout);
  }
  task.waits_on = {{.kind = Wait::Kind::action,
                    .arm = arm,
                    .detail = name + (has_other ? " has another job first" : " is stopped")}};
  return false;
}

// An output is set when its device has reported the value. While there is no connection, the step
// waits.
bool TaskActions::set_output(Task& task, const std::string& name, const SignalValue& value) {
  const SignalView& signal = signals_.views()[cell_->io.find_signal(name)->index()];
  if (signal.is_connected && signal.value == value && !signal.commanded) return true;
  if (signal.is_connected && signal.commanded != value) (void)signals_.command(name, value);
  if (signal.value == value && !signal.commanded) return true;
  const std::string why = signal.is_connected ? "has not reported the value yet" : signal.detail;
  task.waits_on = {{.kind = Wait::Kind::io,
                    .detail = "output " + name + ": device " + signal.device + ": " + why,
                    .signal = name}};
  return false;
}

Result<bool> TaskActions::changed_holding(Task& task, const std::string& object,
                                          PlanningScene::Content content) {
  if (auto done = scene_.change(std::move(content)); !done) return failure(std::move(done.error()));
  TouchOf next = task.touch;
  next[object] = touch_in(*scene_.scene(), object);
  set_touch(task, next);
  StartLog* log = execution_.starts().log();
  if (log == nullptr) return true;
  task.awaits_record = true;
  log->has_moved(task.id, place_of(*scene_.scene(), object), [this, id = task.id] {
    clock_.note({ExecutiveInput::StartWritten{only_step(id)}});
    if (Task* known = tasks_.find(id)) known->awaits_record = false;
    go_on_();
  });
  return true;
}

Result<CollisionObject> TaskActions::detach(const std::string& object) {
  const std::vector<ArmId> arms = armloom::arms_of(*cell_, hands_at(*scene_.scene(), object));
  if (arms.empty()) {
    const auto found = std::ranges::find(scene_.objects(), object, &CollisionObject::name);
    if (found == scene_.objects().end()) return failure(no_object(object));
    return failure(Problem{ProblemKind::conflict, "not-held", "",
                           "no arm holds \"" + object + "\": it is part of the scene", object});
  }
  for (const ArmId arm : arms) {
    if (auto used = arm_in_use(arm, object)) return failure(*std::move(used));
  }
  auto content = detached(*scene_.scene(), execution_.motions().measured(), object);
  if (!content) return failure(std::move(content.error()));
  if (auto done = scene_.change(*std::move(content)); !done) {
    return failure(std::move(done.error()));
  }
  TouchOf left{{object, touch_in(*scene_.scene(), object)}};
  for (const std::string& at : touch_left_.change(left, {}, arms)) show_touch(at);
  return place_of(*scene_.scene(), object).object;
}

// Returns the problem that the arm moves, or is used by a job, so that it cannot let the object go.
std::optional<Problem> TaskActions::arm_in_use(ArmId arm, const std::string& object) const {
  const std::string& name = cell_->arm(arm).name;
  if (execution_.motions().moving(arm)) {
    return Problem{ProblemKind::conflict, "arm-moves", "",
                   "arm " + name +
                       " moves: wait until it rests, or stop it with "
                       "POST /arms/" +
                       name + "/stop",
                   object};
  }
  for (const Task* task : tasks_.begun()) {
    if (!moves(*task, arm)) continue;
    const std::string& key = jobs_.key(task->id);
    return Problem{ProblemKind::conflict, "job-under-way", "",
                   "job " + key + " is under way and uses arm " + name +
                       ": cancel it first with DELETE /jobs/" + key,
                   object};
  }
  return std::nullopt;
}

// Sets what the task allows to touch.
void TaskActions::set_touch(Task& task, const TouchOf& next) {
  const auto changed = touch_left_.change(task.touch, next, arms_of(task));
  for (const std::string& object : changed) show_touch(object);
}

// Returns the arms that the task moves.
std::vector<ArmId> TaskActions::arms_of(const Task& task) const {
  std::vector<ArmId> arms;
  for (const JobId motion : task.motions()) {
    const auto& moved = scheduler_.find(motion)->trajectory->arms();
    arms.insert(arms.end(), moved.begin(), moved.end());
  }
  return arms;
}

bool TaskActions::moves(const Task& task, ArmId arm) const {
  const std::vector<ArmId> arms = arms_of(task);
  return std::ranges::find(arms, arm) != arms.end();
}

void TaskActions::clear_left_touch(const std::vector<ArmId>& arms) {
  for (const std::string& object : touch_left_.of(arms)) show_touch(object);
}

// Returns what the present steps of all tasks allow the object to touch. While an arm carries it,
// only tasks that move this arm count: no other hand may be at an object that moves.
Touch TaskActions::present_touch(const std::string& object) const {
  const auto carrier = carrier_of(*scene_.scene(), object);
  Touch touch;
  for (const JobId id : tasks_.active()) {
    const Task& task = *tasks_.find(id);
    const auto of = task.touch.find(object);
    if (of == task.touch.end()) continue;
    if (carrier && !moves(task, *cell_->link(*carrier).arm)) continue;
    touch.add(of->second);
  }
  return touch;
}

// Allows in the scene what the steps allow at present, and what ended steps left.
void TaskActions::show_touch(const std::string& object) {
  Touch touch = touch_left_.allowed(scene_.scene(), execution_.motions().measured(), object,
                                    present_touch(object));
  if (touch_in(*scene_.scene(), object) == touch) return;
  // Names and links are known.
  (void)scene_.change(touching(*scene_.scene(), object, std::move(touch)));
}

void TaskActions::fire_triggers(const MotionReport& report) {
  Task* task = tasks_.find(report.step.job);
  if (task == nullptr || task->end) return;
  for (TaskStep& step : task->steps) {
    const auto* motion = std::get_if<MotionStepRequest>(&step.request.what);
    if (step.job != report.step.job || motion == nullptr) continue;
    const double duration_s = to_seconds(scheduler_.find(*step.job)->trajectory->duration());
    while (step.triggers_fired < motion->triggers.size()) {
      const TriggerRequest& next = motion->triggers[step.triggers_fired];
      if (to_seconds(report.progress) < next.at * duration_s) break;
      ++step.triggers_fired;
      if (!signals_.command(next.signal, next.value)) {
        publisher_.tell(
            Alert{Alert::Level::error, "job " + jobs_.key(task->id) + ": trigger at " +
                                           std::to_string(next.at) + ": output " + next.signal +
                                           " is not connected, and was not set"},
            clock_.now);
      }
    }
  }
}

}  // namespace armloom
