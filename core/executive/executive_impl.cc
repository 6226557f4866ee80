#include "core/executive/executive_impl.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/guard_words.h"
#include "core/executive/holding.h"

namespace armloom {
namespace {

// Without a connection, the value is only assumed: no job may start for it.
SignalChanged input_of(const SignalView& signal) {
  return {signal.name, signal.is_connected ? signal.value : std::nullopt, signal.detail};
}

}  // namespace

Executive::Impl::Impl(Checked checked, ExecutiveOptions options, JudgementService& judges,
                      Observer& observer)
    : cell_(checked.cell),
      scheduler_(cell_, std::move(checked.policy), cell_->home(), options.first_job),
      jobs_(scheduler_, tasks_, {options.ended_kept, options.ended_bytes_max}, options.first_job),
      scene_(std::move(checked.scene),
             [this]() -> const Configuration& { return execution_.motions().measured(); },
             {.asked = [this](const ExecutiveInput& input) { clock_.note(input); },
              .changed = [this](ClearanceQuery& query) { scene_has_changed(query); },
              .now = [this] { return clock_.now; }}),
      signals_(
          cell_->io, std::move(options.write_signal),
          {.asked = [this](const ExecutiveInput& input) { return clock_.note(input), clock_.now; },
           .changed = [this](SignalId signal) { signal_changed(signal); },
           .now = [this] { return clock_.now; },
           .alert = [this](Alert alert) { publisher_.tell(std::move(alert), clock_.now); }}),
      execution_(
          cell_, {std::move(checked.arms), scene_.scene()->fingerprint()}, options.starts,
          [this](const ExecutiveInput& input) {
            clock_.note(input);
            clock_.quiet = false;  // a fault may change reports of arms at rest
            return clock_.now;
          },
          {.certify = [this](const Question& question) { certify(question); },
           .refused = [this](StepId id, const GuardRefusal& r) { refused(id.job, r); },
           .allowed =
               [this](StepId id) { publisher_.tell_job(publisher_.view(id.job), clock_.now); }}),
      questions_(scheduler_, tasks_, jobs_, judges),
      clock_{.monitored = options.monitored,
             .dies_at = options.dies_at,
             .inputs = options.inputs,
             .count = RunCount(cell_->arms.size())},
      publisher_({*cell_, scheduler_, execution_.motions(), execution_.gate(), jobs_,
                  execution_.starts(), scene_, signals_, tasks_},
                 observer),
      watch_(modules(),
             {.stop = [this](ArmId arm, const std::string& cause) { stop({arm}, cause); },
              .resume = [this](ArmId arm) { resume({arm}); }}),
      clients_{
          .intake = JobIntake(cell_, {scheduler_, jobs_, tasks_, [this] { return scene_.scene(); }},
                              {options.waiting_max, options.active_bytes_max}),
          .tasks = TaskRun(modules(), clients_.intake,
                           [this](JobId id) { clients_.desk.end(id, clock_.now); }),
          .desk = JobDesk(modules(), clients_.intake, clients_.tasks,
                          [this](JobId id) { scheduler_.forget(id); }),
          .inquiries =
              InquiryDesk(modules(), clients_.intake, clients_.tasks.actions().touch_left())} {
  follow_policy();
  for (const SignalView& signal : signals_.views()) step(input_of(signal));
}

Modules Executive::Impl::modules() {
  return {cell_,
          scheduler_,
          tasks_,
          jobs_,
          scene_,
          signals_,
          execution_,
          questions_,
          clock_,
          publisher_,
          [this](const Input& input) { step(input); }};
}

// ---- The scheduler and its effects ----

void Executive::Impl::step(const Input& input) {
  const std::vector<Effect> effects = decided(input);
  for (const Effect& effect : effects) carry_out(effect);
  clear_left_touch(effects);
  if (const auto* report = std::get_if<MotionReport>(&input)) {
    clients_.tasks.actions().fire_triggers(*report);
    if (effects.empty()) return;
  }
  if (!clock_.wind_down) publisher_.tell_stops();  // a shutdown needs no resume
  publisher_.queue_may_have_changed(clock_.now);
  publisher_.publish_step(clock_.now);
  clients_.tasks.go_on_with_tasks();
}

// Clears contact that arms have left by the end of their motions. Call after all effects, because
// this changes the scene, which is a step of its own.
void Executive::Impl::clear_left_touch(const std::vector<Effect>& effects) {
  std::vector<ArmId> arms;
  for (const Effect& effect : effects) {
    const auto* changed = std::get_if<JobChanged>(&effect);
    const Step* step = changed == nullptr ? nullptr : scheduler_.find(changed->job);
    if (step == nullptr || !step->has_ended() || !step->trajectory) continue;
    const auto& moved = step->trajectory->arms();
    arms.insert(arms.end(), moved.begin(), moved.end());
  }
  if (!arms.empty()) clients_.tasks.actions().clear_left_touch(arms);
}

// Stops all arms on their paths if an invariant is broken. The process then ends.
std::vector<Effect> Executive::Impl::decided(const Input& input) {
  try {
    return scheduler_.step(input, clock_.now);
  } catch (const std::logic_error&) {
    execution_.brake_all();
    throw;
  }
}

void Executive::Impl::carry_out(const Effect& effect) {
  if (const auto* judge = std::get_if<Judge>(&effect)) {
    questions_.judge(judge->question, scene_.scene(), [this](const Judged& made) {
      publisher_.tell_judged(made.verdict.evaluations);
      clock_.note({ExecutiveInput::Judged{made.verdict.evaluations, made.verdict.interrupted}});
      execution_.gate().take(made.verdict.certificates);
      hide_checks();
      step(made);
    });
  } else if (const auto* plan = std::get_if<PlanMotion>(&effect)) {
    questions_.plans().ask(*plan, scene_.scene(), [this](const PlanMade& made) {
      clock_.note({ExecutiveInput::Planned{made.step, made.question}});
      step(made);
    });
  } else if (const auto* dispatch = std::get_if<Dispatch>(&effect)) {
    const auto written = [this](StepId id) {
      clock_.note({ExecutiveInput::StartWritten{id}});
      step(StartRecorded{id});
      const Step* started = scheduler_.find(id.job);
      return started != nullptr && started->in<Moving>() != nullptr;
    };
    execution_.carry_out(*dispatch, *scheduler_.find(dispatch->step.job), written);
  } else if (const auto* grant = std::get_if<Grant>(&effect)) {
    execution_.carry_out(*grant);
  } else if (const auto* aside = std::get_if<YieldMove>(&effect)) {
    note_aside(*aside);
  } else if (const auto* brake = std::get_if<Brake>(&effect)) {
    execution_.carry_out(*brake);
  } else if (const auto* release = std::get_if<Release>(&effect)) {
    execution_.carry_out(*release);
  } else if (const auto* changed = std::get_if<JobChanged>(&effect)) {
    job_changed(changed->job);
  } else if (const auto* wake = std::get_if<WakeAt>(&effect)) {
    clock_.wake_at = wake->when;
  }
}

void Executive::Impl::note_aside(const YieldMove& aside) {
  const std::string arm = cell_->arm(aside.arm).name;
  const std::string blocked = jobs_.key(aside.blocked_job);
  const OwnJob kind = aside.to_start ? OwnJob::move_to_start : OwnJob::retreat;
  const std::string name = aside.to_start   ? arm + " moves to the start of " + blocked
                           : !aside.returns ? arm + " retreats for " + blocked
                           : aside.in_ring  ? arm + " returns to where it rested"
                                            : arm + " returns to where it was left";
  jobs_.add(aside.job, {jobs_.own_key(kind), name});
}

void Executive::Impl::job_changed(JobId id) {
  const Step& changed = *scheduler_.find(id);
  if (changed.has_ended()) {
    questions_.plans().give_up(id);
    questions_.give_up(id);
    execution_.forget(changed);
  }
  if (Task* task = tasks_.find(id)) return clients_.tasks.motion_changed(*task, id);
  if (jobs_.has_ended(id)) return;  // a step within this one has told it
  JobView view = publisher_.view(id);
  if (changed.has_ended()) clients_.desk.end(id, *view.times.ended_at);
  publisher_.tell_job(std::move(view), clock_.now);
}

// Shows the progress of a long check, without an event because it depends on this machine.
void Executive::Impl::show_check() {
  constexpr Duration kShownAgain = std::chrono::milliseconds(250);
  clock_.shows_check_at = clock_.now + kShownAgain;
  if (!questions_.asked()) return;
  for (const Motion& motion : questions_.asked()->candidates) {
    const JobId job = motion.step.job;
    if (scheduler_.find(job) == nullptr) continue;
    JobView view = publisher_.view(job);
    if (!questions_.tell_check(view)) return;
    questions_.note_shown(job);
    publisher_.show(std::move(view), clock_.now);
  }
}

void Executive::Impl::hide_checks() {
  for (JobId job : questions_.take_shown()) {
    if (scheduler_.find(job) != nullptr) publisher_.show(publisher_.view(job), clock_.now);
  }
}

// ---- Time ----

void Executive::Impl::tick(TimePoint now) {
  clock_.now = now;
  ++clock_.ticks;
  if (clock_.dies_at && now >= *clock_.dies_at) {
    execution_.tick_arms(now);
    publisher_.tell_tick(now);
    return;
  }
  const Motions& motions = execution_.motions();
  clock_.quiet = motions.all_settled();
  if (clock_.wake_at && now >= *clock_.wake_at) {
    clock_.wake_at.reset();
    clock_.quiet = false;
    step(Wake{});
  }
  for (const std::string& job : clock_.held.let_go(now)) {
    clock_.quiet = false;
    static_cast<void>(clients_.desk.cancel(job, {}));  // it may have ended
  }
  for (const MotionReport& report : execution_.tick(now)) {
    clock_.quiet = false;
    if (execution_.keeps_back(report)) continue;
    clients_.tasks.end_contact(report);
    watch_.take(report);
  }
  for (const StepId id : execution_.gate().refused_for_long()) {
    const GuardRefusal why = *execution_.gate().refusal(id);
    step(Refused{id, why.other, sentence(why, *cell_)});
  }
  if (clients_.tasks.actions().takes_wake()) {
    clock_.quiet = false;
    clients_.tasks.go_on_with_tasks();
  }
  if (now >= clock_.shows_check_at) show_check();
  clients_.desk.forget_rolled_back();
  clock_.count.motion(motions);
  watch_.tick();
  publisher_.tell_queue(now);
  publisher_.tell_scene(now);
  publisher_.tell_arms(now);
  publisher_.tell_tick(now);
  // A lost arm is not waited for: it comes to rest by itself.
  const auto is_moving = [&](ArmId arm) {
    return motions.moving(arm) && motions.link(arm).state() != ArmLink::State::lost;
  };
  auto& wind_down = clock_.wind_down;
  if (wind_down && wind_down->done && std::ranges::none_of(all_arms(*cell_), is_moving)) {
    clients_.tasks.interrupt(wind_down->keeps_waiting);
    std::exchange(wind_down->done, nullptr)();
  }
}

TimePoint Executive::Impl::settled_until() const {
  const bool settled = clock_.quiet && execution_.motions().all_settled() &&
                       execution_.gate().is_idle() && !publisher_.is_behind();
  if (!settled) return clock_.now;
  return std::min({clock_.wake_at.value_or(TimePoint::max()), clock_.held.next(),
                   clients_.tasks.actions().wakes_at(), scene_.expiry().at});
}

// ---- The guard ----

void Executive::Impl::follow_policy() {
  const bool certified = scheduler_.policy().has_orders();
  execution_.gate().set_certified(certified);
  if (certified) return;
  publisher_.tell(Alert{Alert::Level::info, "policy " + std::string(scheduler_.policy().name) +
                                                ": no certificates; the authority guard is off"},
                  clock_.now);
}

void Executive::Impl::certify(const Question& question) {
  questions_.service().certify(question, scene_.scene(), [this](const Verdict& verdict) {
    clock_.note({ExecutiveInput::Certified{verdict.evaluations}});
    execution_.gate().certified(verdict.certificates);
  });
}

void Executive::Impl::refused(JobId job, const GuardRefusal& refusal) {
  GuardEvent event{.refusal = refusal,
                   .arm = cell_->arm(refusal.arm).name,
                   .job = jobs_.key(job),
                   .other_arm = {},
                   .other_job = {}};
  if (refusal.other) {
    event.other_arm = cell_->arm(*refusal.other).name;
    const auto on = execution_.gate().step_of(*refusal.other);
    if (on) event.other_job = jobs_.key(on->job);
  }
  clock_.count.guard_refusal();
  publisher_.tell(std::move(event), clock_.now);
  publisher_.tell(
      Alert{Alert::Level::error, "job " + jobs_.key(job) + ": " + sentence(refusal, *cell_) +
                                     "; the arm moves no farther than before"},
      clock_.now);
  publisher_.tell_job(publisher_.view(job), clock_.now);
}

void Executive::Impl::scene_has_changed(ClearanceQuery& query) {
  const SceneFingerprint& now = scene_.scene()->fingerprint();
  const bool is_within_reach = now != execution_.gate().scene();
  const std::vector<ArmId> arms = arms_in_question(execution_.gate().scene(), now);
  execution_.gate().look_at(now);
  watch_.follow(query);
  publisher_.scene_has_changed(clock_.now);
  set_brakes();
  if (is_within_reach) step(SceneChanged{arms, shared_holds(*cell_, hands_of(*scene_.scene()))});
  // If a client moves an object, the contact that ended steps left at it ends.
  const bool is_edit = scene_.version() != scene_.version_of_change();
  if (is_edit) clients_.tasks.actions().clear_left_touch(all_arms(*cell_));
}

void Executive::Impl::signal_changed(SignalId signal) {
  publisher_.tell_signal(signal, clock_.now);
  step(input_of(signals_.views()[signal.index()]));
}

}  // namespace armloom
