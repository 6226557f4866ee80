#include "core/executive/publishing.h"

#include <algorithm>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/guard_words.h"
#include "core/executive/holding.h"
#include "core/executive/task_view.h"

namespace armloom {
namespace {

constexpr std::size_t kSmallScene = 100;                             // objects
constexpr Duration kForEachObject = std::chrono::microseconds(100);  // between two events
constexpr std::size_t kShortQueue = 100;                             // jobs
constexpr Duration kForEachJob = std::chrono::microseconds(100);     // between two lists

std::vector<std::string> names_of(const Cell& cell, const std::vector<LinkId>& links) {
  std::vector<std::string> names;
  for (const LinkId link : links) names.push_back(cell.link(link).name);
  return names;
}

Alert alert_of_expired(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 5;
  std::string text = std::to_string(names.size()) +
                     (names.size() == 1 ? " object has" : " objects have") +
                     " expired and left the scene: ";
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > kNamed) text += " and " + std::to_string(names.size() - kNamed) + " more";
  return {Alert::Level::warning,
          text + "; to keep objects, send PUT /scene before expires_in_s is over"};
}

}  // namespace

Publisher::Publisher(const Shown& shown, Observer& observer)
    : shown_(shown), observer_(observer), arms_(shown) {
  told_.queue = queue();
  publish_scene();
  publish_signals();
  arms_.look();
  publish({});
}

void Publisher::tell(Body body, TimePoint now) {
  publish(now);
  observer_.on_event(Event{++seq_, now, std::move(body)});
}

void Publisher::scene_has_changed(TimePoint now) {
  publish_scene();
  scene_pace_.is_behind = true;
  tell_scene(now);
  if (const auto& names = shown_.scene.expired(); !names.empty()) {
    tell(alert_of_expired(names), now);
  }
}

void Publisher::tell_scene(TimePoint now) {
  const bool is_due = now >= scene_pace_.next || shown_.scene.version_of_change() > told_.scene;
  if (!scene_pace_.is_behind || !is_due) return;
  scene_pace_.is_behind = false;
  told_.scene = shown_.scene.version();
  const std::size_t objects = shown_.scene.objects().size();
  scene_pace_.next =
      objects < kSmallScene ? now : now + static_cast<Duration::rep>(objects) * kForEachObject;
  tell(scene(), now);
}

void Publisher::tell_signal(SignalId signal, TimePoint now) {
  publish_signals();
  tell(shown_.signals.views()[signal.index()], now);
}

SceneView Publisher::scene() const {
  const PlanningScenePtr& scene = shown_.scene.scene();
  SceneView view{shown_.scene.version(), {scene, &scene->objects()}};
  for (const Attachment& held : scene->attachments()) {
    HeldView& shown = view.held.emplace_back(place_of(*scene, held.object.name));
    shown.touch = names_of(shown_.cell, held.touch);
    shown.touch.insert(shown.touch.end(), held.touch_objects.begin(), held.touch_objects.end());
  }
  for (const AllowedTouch& allowed : scene->touch()) {
    view.touch.push_back({allowed.object, names_of(shown_.cell, allowed.links)});
  }
  if (const SceneExpiry& expiry = shown_.scene.expiry(); expiry.names) {
    view.expires_at = expiry.at;
    view.expiring = expiry.names;
  }
  view.expired = shown_.scene.expired();
  return view;
}

void Publisher::tell_job(JobView view, TimePoint now) {
  std::optional<Alert> alert;
  if (view.state == JobState::failed || view.state == JobState::expired) {
    alert = Alert{Alert::Level::warning,
                  "job " + view.key + " " + to_string(view.state) + ": " +
                      (view.detail().empty() ? to_string(*view.reason()) : view.detail())};
  }
  note(view);
  tell(std::move(view), now);
  if (alert) tell(std::move(*alert), now);
}

void Publisher::tell_tick(TimePoint now) {
  if (const bool at_rest = shown_.motions.all_at_rest(); at_rest != told_.rest) {
    told_.rest = at_rest;
    observer_.on_rest(at_rest);
  }
  publish(now);
  observer_.on_tick(now, shown_.motions.measured());
  observer_.on_truth(now, shown_.motions.true_positions());
}

void Publisher::tell_arms(TimePoint now) {
  arms_.look();
  for (ArmView& view : arms_.take_changed()) tell(std::move(view), now);
}

void Publisher::tell_stops() {
  std::vector<ArmId> stops = all_arms(shown_.cell);
  std::erase_if(stops, [&](ArmId arm) { return !shown_.scheduler.stopped(arm); });
  if (stops == told_.stops) return;
  told_.stops = std::move(stops);
  observer_.on_stops(told_.stops);
}

void Publisher::queue_may_have_changed(TimePoint now) {
  queue_pace_.is_behind = true;
  tell_queue(now);
}

void Publisher::tell_queue(TimePoint now) {
  if (!queue_pace_.is_behind) return;
  if (now < queue_pace_.next) return tell_stopped(now);
  queue_pace_.is_behind = false;
  const QueueView& present = queue();
  const std::size_t jobs = shown_.jobs.active();
  queue_pace_.next =
      jobs < kShortQueue ? now : now + static_cast<Duration::rep>(jobs) * kForEachJob;
  if (present == told_.queue) return;
  tell_queue(present, now);
}

// Publishes a stop at once, with the previous lists: new ones take long with thousands of jobs.
void Publisher::tell_stopped(TimePoint now) {
  const bool stopped = arms_.all_stopped();
  const double speed = shown_.scheduler.state().speed.cell();
  const bool is_news = told_.queue.stopped != stopped || told_.queue.speed_override != speed;
  told_.queue.stopped = stopped;
  told_.queue.speed_override = speed;
  if (is_news) tell_queue(std::move(told_.queue), now);
}

// Moves the lists through the event instead of copying them.
void Publisher::tell_queue(QueueView queue, TimePoint now) {
  publish(now);
  Event event{++seq_, now, std::move(queue)};
  observer_.on_event(event);
  told_.queue = std::get<QueueView>(std::move(event.body));
}

void Publisher::tell_state(const std::vector<Proximity>& near, TimePoint now) {
  observer_.on_state(StateFrame{now, shown_.motions.measured(), near, arms_.authorities()});
}

JobView Publisher::view(JobId id) const {
  const Task* task = shown_.tasks.find(id);
  const JobId shown = shown_.tasks.present_motion(id);
  JobView view = task == nullptr ? view_of(*shown_.scheduler.find(id), shown_.cell, shown_.jobs)
                                 : view_of(*task, shown_.scheduler, shown_.cell, shown_.jobs);
  view.times.expires_at = shown_.scheduler.expiry(shown);
  const JobLabel* label = shown_.jobs.label(id);
  if (label != nullptr && label->submitted_at) view.times.submitted_at = *label->submitted_at;
  if (const auto refusal = shown_.gate.refusal(only_step(shown))) {
    WaitView& wait = view.waits_on.emplace_back(WaitView{.kind = Wait::Kind::guard});
    if (refusal->other) wait.arm = shown_.cell.arm(*refusal->other).name;
    wait.detail = sentence(*refusal, shown_.cell);
  }
  return view;
}

// ---- What is published ----

void Publisher::note(JobView view) {
  lists_.put(view);
  board_->add_key(view.key, view.id);
  const bool is_explained =
      view.state != JobState::queued && !is_terminal(view.state) && !view.waits_on.empty();
  is_explained ? (void)explained_.insert(view.id) : (void)explained_.erase(view.id);
  jobs_.put(std::make_shared<const JobView>(std::move(view)));
}

void Publisher::publish_step(TimePoint now) {
  const std::vector<JobId> explained(explained_.begin(), explained_.end());
  for (JobId job : explained) note(view(job));
  arms_.look();
  publish(now);
}

void Publisher::show(JobView view, TimePoint now) {
  note(std::move(view));
  publish(now);
}

void Publisher::publish(TimePoint now) {
  board_->publish({.seq = seq_,
                   .time = now,
                   .policy = shown_.scheduler.policy().name,
                   .stopped = arms_.all_stopped(),
                   .speed_override = shown_.scheduler.state().speed.cell(),
                   .jobs = jobs_.share(),
                   .q = shown_.motions.measured(),
                   .arms = arms_.present()},
                  gone_);
  gone_.clear();
}

void Publisher::publish_signals() {
  board_->publish_signals(std::make_shared<const std::vector<SignalView>>(shown_.signals.views()));
}

void Publisher::publish_scene() {
  board_->publish_scene(std::make_shared<const SceneView>(scene()));
}

void Publisher::forget(JobId job, const std::string& key) {
  gone_.emplace_back(key, job);
  explained_.erase(job);
  jobs_.erase(job);
}

const QueueView& Publisher::queue() {
  QueueView& view = lists_.view();
  view.policy = shown_.scheduler.policy().name;
  view.stopped = arms_.all_stopped();
  view.speed_override = shown_.scheduler.state().speed.cell();
  return view;
}

}  // namespace armloom
