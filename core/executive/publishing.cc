#include "core/executive/publishing.h"

#include <algorithm>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/guard_words.h"
#include "core/executive/holding.h"
#include "core/executive/task_view.h"

namespace armloom {
namespace {

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
    : shown_(shown),
      observer_(observer),
      arms_(shown.cell.arms.size()),
      told_arms_(shown.cell.arms.size()),
      told_queue_(queue()) {
  publish_scene();
  publish_signals();
  look_at_arms();
  publish({});
}

void Publisher::tell(Body body, TimePoint now) {
  publish(now);
  observer_.on_event(Event{++seq_, now, std::move(body)});
}

void Publisher::scene_has_changed(TimePoint now) {
  publish_scene();
  scene_is_old_ = true;
  tell_scene(now);
  if (const auto& names = shown_.scene.expired(); !names.empty()) {
    tell(alert_of_expired(names), now);
  }
}

void Publisher::tell_scene(TimePoint now) {
  const bool is_due = now >= next_scene_ || shown_.scene.version_of_change() > told_scene_;
  if (!scene_is_old_ || !is_due) return;
  scene_is_old_ = false;
  told_scene_ = shown_.scene.version();
  const std::size_t objects = shown_.scene.objects().size();
  next_scene_ =
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
  if (const bool at_rest = shown_.motions.all_at_rest(); at_rest != told_rest_) {
    told_rest_ = at_rest;
    observer_.on_rest(at_rest);
  }
  publish(now);
  observer_.on_tick(now, shown_.motions.measured());
  observer_.on_truth(now, shown_.motions.true_positions());
}

void Publisher::tell_arms(TimePoint now) {
  look_at_arms();
  for (ArmId arm : all_arms(shown_.cell)) {
    const ArmStatus& status = arms_[arm.index()];
    ArmStatus& told = told_arms_[arm.index()];
    const bool is_same = status.state == told.state && status.job == told.job &&
                         status.link == told.link && status.drives_on == told.drives_on &&
                         status.stop_cause == told.stop_cause &&
                         status.speed_override == told.speed_override &&
                         status.effective_speed_override == told.effective_speed_override;
    if (is_same) continue;
    told = status;
    tell(view_of_arm(arm, status), now);
  }
}

void Publisher::tell_stops() {
  std::vector<ArmId> stops = all_arms(shown_.cell);
  std::erase_if(stops, [&](ArmId arm) { return !shown_.scheduler.stopped(arm); });
  if (stops == told_stops_) return;
  told_stops_ = std::move(stops);
  observer_.on_stops(told_stops_);
}

void Publisher::queue_may_have_changed(TimePoint now) {
  queue_is_old_ = true;
  tell_queue(now);
}

void Publisher::tell_queue(TimePoint now) {
  if (!queue_is_old_) return;
  if (now < next_queue_) return tell_stopped(now);
  queue_is_old_ = false;
  const QueueView& present = queue();
  const std::size_t jobs = shown_.jobs.active();
  next_queue_ = jobs < kShortQueue ? now : now + static_cast<Duration::rep>(jobs) * kForEachJob;
  if (present == told_queue_) return;
  tell_queue(present, now);
}

// With the lists as they were told: to make those of thousands takes longer than all else of a
// stop.
void Publisher::tell_stopped(TimePoint now) {
  const bool stopped = all_stopped();
  const double speed = shown_.scheduler.state().speed.cell();
  const bool is_news = told_queue_.stopped != stopped || told_queue_.speed_override != speed;
  told_queue_.stopped = stopped;
  told_queue_.speed_override = speed;
  if (is_news) tell_queue(std::move(told_queue_), now);
}

// The lists of thousands are moved through the event, not copied once more.
void Publisher::tell_queue(QueueView queue, TimePoint now) {
  publish(now);
  Event event{++seq_, now, std::move(queue)};
  observer_.on_event(event);
  told_queue_ = std::get<QueueView>(std::move(event.body));
}

bool Publisher::all_stopped() const {
  return std::ranges::all_of(all_arms(shown_.cell),
                             [this](ArmId arm) { return shown_.scheduler.stopped(arm); });
}

void Publisher::tell_state(const std::vector<Proximity>& near, TimePoint now) {
  observer_.on_state(StateFrame{now, shown_.motions.measured(), near, authorities()});
}

std::vector<ArmAuthority> Publisher::authorities() const {
  std::vector<ArmAuthority> all;
  for (const Motions::UnderWay& motion : shown_.motions.under_way()) {
    all.push_back({shown_.cell.arm(motion.arm).name, shown_.jobs.key(motion.step.job),
                   motion.progress, motion.authority});
  }
  return all;
}

JobView Publisher::view(JobId id) const {
  const Task* task = shown_.tasks.find(id);
  const JobId shown = task == nullptr ? id : task->next_motion().value_or(id);
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
  look_at_arms();
  publish(now);
}

void Publisher::show(JobView view, TimePoint now) {
  note(std::move(view));
  publish(now);
}

void Publisher::look_at_arms() {
  for (ArmId arm : all_arms(shown_.cell)) arms_[arm.index()] = status_of(arm);
}

void Publisher::publish(TimePoint now) {
  board_->publish({.seq = seq_,
                   .time = now,
                   .policy = shown_.scheduler.policy().name,
                   .stopped = all_stopped(),
                   .speed_override = shown_.scheduler.state().speed.cell(),
                   .jobs = jobs_.share(),
                   .q = shown_.motions.measured(),
                   .arms = arms_},
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
  view.stopped = all_stopped();
  view.speed_override = shown_.scheduler.state().speed.cell();
  return view;
}

// ---- Arms ----

// Of a job that has not begun: it may not leave where it stands before that is on disk.
bool Publisher::is_told_of_a_start(ArmId arm) const {
  const auto job = shown_.scheduler.occupant(arm);
  return job && shown_.starts.knows(*job) && !shown_.scheduler.find(*job)->times.started_at;
}

ArmState Publisher::state_of(ArmId arm) const {
  using Phase = ArmFeedback::Phase;
  const Phase phase = shown_.motions.feedback(arm).phase;
  if (phase == Phase::fault) return ArmState::fault;
  // A lost arm has come to rest, or will do so; what it does is not known.
  const bool is_lost = shown_.motions.link(arm).state() == ArmLink::State::lost;
  const bool moves = shown_.motions.moving(arm) && !is_lost && !is_told_of_a_start(arm);
  if (shown_.scheduler.stopped(arm) && !moves) return ArmState::stopped;
  const auto job = shown_.scheduler.occupant(arm);
  if (job && shown_.scheduler.find(*job)->pausing()) return ArmState::paused;
  if (moves) return ArmState::moving;
  return job && phase == Phase::stopped ? ArmState::paused : ArmState::idle;
}

ArmStatus Publisher::status_of(ArmId arm) const {
  const double deviation_max_rad = arms_[arm.index()].deviation_max_rad;
  ArmStatus status{.state = state_of(arm),
                   .stopped = shown_.scheduler.stopped(arm),
                   .deviation_rad = shown_.motions.deviation(arm, deviation_max_rad),
                   .link = shown_.motions.link(arm).state(),
                   .link_detail = shown_.motions.link(arm).detail(),
                   .drives_on = shown_.motions.feedback(arm).drives_on,
                   .speed_override = shown_.scheduler.state().speed.arm(arm),
                   .effective_speed_override = shown_.scheduler.state().speed.effective(arm)};
  if (const auto& stop = shown_.scheduler.state().arms.stop_of(arm))
    status.stop_cause = stop->cause;
  status.deviation_max_rad = std::max(deviation_max_rad, status.deviation_rad);
  status.job = shown_.scheduler.occupant(arm);
  if (status.job) {
    const Step& step = *shown_.scheduler.find(*status.job);
    status.progress = to_seconds(step.progress) / to_seconds(step.trajectory->duration());
  }
  return status;
}

ArmView Publisher::view_of_arm(ArmId arm, const ArmStatus& status) const {
  return view_of(status, arm, shown_.cell, shown_.motions.measured(),
                 status.job ? shown_.jobs.key(*status.job) : std::string());
}

std::vector<ArmView> Publisher::arms() const {
  std::vector<ArmView> arms;
  for (ArmId arm : all_arms(shown_.cell)) arms.push_back(view_of_arm(arm, status_of(arm)));
  return arms;
}

}  // namespace armloom
