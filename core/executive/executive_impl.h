#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/executive/execution.h"
#include "core/executive/executive.h"
#include "core/executive/executive_input.h"
#include "core/executive/hold_to_run.h"
#include "core/executive/job_intake.h"
#include "core/executive/job_register.h"
#include "core/executive/left_touch.h"
#include "core/executive/link_watch.h"
#include "core/executive/live_scene.h"
#include "core/executive/open_questions.h"
#include "core/executive/publishing.h"
#include "core/executive/run_count.h"
#include "core/executive/signals.h"
#include "core/executive/state_watch.h"
#include "core/executive/task.h"
#include "core/scheduler/scheduler.h"
#include "core/scheduler/trial.h"

namespace armloom {

class TaskPreview;

// The modules of the executive and their connections.
class Executive::Impl {
 public:
  // Inputs that Executive::create() has checked or made; the arms are at home.
  struct Checked {
    CellPtr cell;
    PlanningScenePtr scene;
    std::shared_ptr<const Policy> policy;
    std::vector<MadeController> arms;
  };
  Impl(Checked checked, ExecutiveOptions options, JudgementService& judges, Observer& observer);

  // submission.cc
  Result<JobView> submit(JobRequest request);
  std::optional<BatchAnswers> go_on(Batch& batch);
  std::vector<Result<JobView>> restore(std::vector<RestoredJob> jobs);

  // job_commands.cc
  Result<JobView> cancel(const std::string& key, std::optional<TimePoint> at);
  void roll_back(const std::string& key);
  Result<JobView> amend(const std::string& key, JobAmendment amendment);
  Result<JobView> replan(const std::string& key);

  // asking.cc
  void check(JobRequest request, std::function<void(Result<CheckView>)> done);
  void plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
            std::function<void(Result<PlanOutcome>)> done);

  // task_asking.cc
  void plan(StepsInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
            std::function<void(Result<StepsPlan>)> done);

  // task_actions.cc
  Result<CollisionObject> detach(const std::string& object);

  // executive_impl.cc
  void note(ExecutiveInput input) const;
  void step(const Input& input);
  void tick(TimePoint now);
  void end(const std::string& cause, bool keeps_waiting, std::function<void()> done);
  void stop(const std::vector<ArmId>& arms, const std::string& cause,
            Alert::Level level = Alert::Level::warning,
            StopCategory category = StopCategory::brake);
  std::vector<ArmId> resume(std::vector<ArmId> arms);
  void set_speed(std::optional<ArmId> arm, double share);
  [[nodiscard]] std::optional<JobView> job(const std::string& key) const;
  [[nodiscard]] TimePoint settled_until() const;
  void follow_policy();

  struct Clock {
    TimePoint now{};
    std::optional<TimePoint> wake_at = {};  // requested by the scheduler
    HoldToRun held = {};                    // jobs that end with their lease
    bool quiet = false;     // in the last cycle all arms were settled and there was no report
    bool monitored = true;  // ExecutiveOptions
    std::optional<TimePoint> dies_at = {};  // likewise
    std::uint64_t ticks = 0;
    InputLog* inputs = nullptr;  // receives the inputs between the ticks
    TimePoint shows_check_at{};  // next publication of a check's progress
  };

  CellPtr cell_;
  Scheduler scheduler_;
  TaskBook tasks_;
  JobRegister jobs_;
  LiveScene scene_;
  Signals signals_;
  Execution execution_;
  OpenQuestions questions_;
  RunCount count_;
  Clock clock_;
  Publisher publisher_;

 private:
  Result<std::vector<PreparedJob>> prepare_all(std::vector<JobRequest> requests);
  JobView accept(PreparedJob prepared);

  // tasks.cc
  JobView accept_task(PreparedJob prepared);
  void enter_task(PreparedJob prepared, JobId id, JobLabel label, bool is_held_over);
  void go_on_with_tasks();
  bool go_on(Task& task);
  [[nodiscard]] const Step* lost_motion(const Task& task) const;
  void tell_stop(Task& task, JobId next);
  bool waits_to_retry(Task& task, const std::string& why);
  bool go_on_with_motion(Task& task, TaskStep& present);
  Result<bool> act(Task& task, const StepRequest& request);
  Result<bool> has_arm_of(Task& task, LinkId link);
  bool set_output(Task& task, const std::string& name, const SignalValue& value);
  Result<bool> changed_holding(Task& task, const std::string& object,
                               PlanningScene::Content content);
  void set_touch(Task& task, const TouchOf& next);
  [[nodiscard]] std::vector<ArmId> arms_of(const Task& task) const;
  void clear_left_touch(const std::vector<ArmId>& arms);
  void show_touch(const std::string& object);
  void fire_triggers(const MotionReport& report);
  void end_task(Task& task, TaskEnd end);
  void fail_task(Task& task, Reason reason, std::string detail);
  void cancel_task(Task& task);
  void tell_task(JobId id);
  void motion_changed(Task& task, JobId motion);
  [[nodiscard]] bool any_stopped(const Task& task) const;
  [[nodiscard]] bool is_recorded(const Task& task);
  void wake_at(TimePoint when);
  void interrupt(bool keeps_waiting);
  void forget_oldest(JobId ended);
  void forget_job(JobId id, const std::string& key);

  void enter(Submit submitted, JobLabel label);
  struct OpenInquiry;
  void plan_next(const std::shared_ptr<OpenInquiry>& inquiry);
  using TrialEnd = Result<Trial::Outcome>;
  // Answers the questions of the trial in this scene.
  void walk(std::shared_ptr<Trial> trial, PlanningScenePtr scene,
            std::function<void(TrialEnd)> done);
  [[nodiscard]] Trial::Open open_now();
  [[nodiscard]] std::vector<ArmId> may_move(const std::vector<ArmId>& staying) const;

  // task_asking.cc
  struct OpenStepsPlan;
  void plan_next(const std::shared_ptr<OpenStepsPlan>& open);
  void plan_motion(const std::shared_ptr<OpenStepsPlan>& open);
  [[nodiscard]] bool go_on(TaskPreview& preview, std::shared_ptr<void> owner,
                           std::function<void(Result<bool>)> arrived);
  struct OpenStepsCheck;
  void check_steps(PreparedJob job, Configuration at, std::function<void(Result<CheckView>)> done);
  void check_next(const std::shared_ptr<OpenStepsCheck>& open);
  [[nodiscard]] Trial trial_of(const OpenStepsCheck& open);

  [[nodiscard]] std::vector<Effect> decided(const Input& input);
  void carry_out(const Effect& effect);
  void note_aside(const YieldMove& aside);
  void job_changed(JobId job);
  void show_check();
  void hide_checks();
  void certify(const Question& question);
  void refused(JobId job, const GuardRefusal& refusal);
  void forget_rolled_back();
  void take(const MotionReport& report);
  void watch();
  void watch_links();
  void tell_unlocated(ArmId arm);
  void locate(ArmId arm);
  void act_on(const std::vector<MonitorFinding>& found);
  void scene_has_changed(ClearanceQuery& query);
  void signal_changed(SignalId signal);

  // Set when the shutdown has begun.
  struct WindDown {
    std::function<void()> done;
    bool keeps_waiting;
  };

  std::set<JobId> checks_shown_;    // jobs that are published as being checked
  std::vector<JobId> rolled_back_;  // not ended, or not forgotten yet
  JobIntake intake_;
  StateWatch watch_;
  LinkWatch links_;
  std::optional<WindDown> wind_down_;
  TimePoint task_wakes_at_ = TimePoint::max();  // a wait of a step is over
  std::set<JobId> tasks_at_end_;                // their last motion has ended
  bool tasks_are_busy_ = false;                 // go_on_with_tasks() runs
  LeftTouch touch_left_;
};

// Returns the problem that too many questions of clients ("checks", "plans") are open.
[[nodiscard]] Problem too_many_open(const std::string& what);

}  // namespace armloom
