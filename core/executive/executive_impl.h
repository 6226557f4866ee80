#pragma once

#include <functional>
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
#include "core/executive/live_scene.h"
#include "core/executive/open_questions.h"
#include "core/executive/publishing.h"
#include "core/executive/run_count.h"
#include "core/executive/state_watch.h"
#include "core/scheduler/scheduler.h"
#include "core/scheduler/trial.h"

namespace armloom {

// The rooms of the executive, and the ways between them: what comes in goes to the scheduler, what
// that decides to the arms, what changes to the publisher.
class Executive::Impl {
 public:
  // What create() has found good, or made: arms stand at home.
  struct Checked {
    CellPtr cell;
    PlanningScenePtr scene;
    std::shared_ptr<const Policy> policy;
    std::vector<std::unique_ptr<FaultyArm>> arms;
  };
  Impl(Checked checked, ExecutiveOptions options, JudgementService& judges, Observer& observer);

  // submission.cc
  Result<JobView> submit(JobRequest request);
  std::optional<BatchAnswers> go_on(Batch& batch);
  std::vector<Result<JobView>> restore(std::vector<RestoredJob> jobs);

  // job_commands.cc
  Result<JobView> cancel(const std::string& key, std::optional<TimePoint> at);
  void withdraw(const std::string& key);
  Result<JobView> amend(const std::string& key, JobAmendment amendment);
  Result<JobView> replan(const std::string& key);

  // asking.cc
  void check(JobRequest request, std::function<void(Result<CheckView>)> done);
  void plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
            std::function<void(Result<PlanOutcome>)> done);

  // executive_impl.cc
  void note(ExecutiveInput input) const;
  void step(const Input& input);
  void tick(TimePoint now);
  void end(const std::string& cause, bool keeps_waiting, std::function<void()> done);
  void stop(const std::vector<ArmId>& arms, const std::string& cause,
            Alert::Level level = Alert::Level::warning);
  void resume(const std::vector<ArmId>& arms);
  [[nodiscard]] std::optional<JobView> job(const std::string& key) const;
  [[nodiscard]] TimePoint settled_until() const;
  void follow_policy();  // whether that has certificates

  struct Clock {
    TimePoint now{};
    std::optional<TimePoint> wake_at = {};  // asked for by the scheduler
    HoldToRun held = {};                    // jobs that end when nobody holds them any more
    bool quiet = false;  // the last cycle found all arms settled, and nothing to report
    std::optional<TimePoint> dies_at = {};  // ExecutiveOptions
    std::uint64_t ticks = 0;                // so many cycles have begun
    InputLog* inputs = nullptr;             // is told what comes between them
    TimePoint shows_check_at{};             // the progress of an open check
  };

  CellPtr cell_;
  Scheduler scheduler_;
  JobRegister jobs_;
  LiveScene scene_;
  Execution execution_;
  OpenQuestions questions_;
  RunCount count_;
  Clock clock_;
  Publisher publisher_;

 private:
  Result<std::vector<PreparedJob>> prepare_all(std::vector<JobRequest> requests);
  JobView accept(PreparedJob prepared);
  void enter(Submit submitted, JobLabel label);
  struct OpenInquiry;
  void plan_next(const std::shared_ptr<OpenInquiry>& inquiry);
  void walk(std::shared_ptr<Trial> trial, std::function<void(Result<CheckView>)> done);

  [[nodiscard]] std::vector<Effect> decided(const Input& input);
  void carry_out(const Effect& effect);
  void note_aside(const YieldMove& aside);
  void job_changed(JobId job);
  void show_check();
  void hide_checks();
  void certify(const Question& question);
  void refused(JobId job, const GuardRefusal& refusal);
  void forget_withdrawn();
  void watch();
  void scene_has_changed(ClearanceQuery query);

  // The last act has begun.
  struct WindDown {
    std::function<void()> done;
    bool keeps_waiting;
  };

  std::set<JobId> checks_shown_;  // jobs that readers see as being checked
  std::vector<JobId> withdrawn_;  // and not ended, or still known
  JobIntake intake_;
  StateWatch watch_;
  std::optional<WindDown> wind_down_;
};

}  // namespace armloom
