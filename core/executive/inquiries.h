#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/executive/executive.h"
#include "core/executive/job_intake.h"
#include "core/executive/left_touch.h"
#include "core/executive/open_questions.h"
#include "core/executive/publishing.h"
#include "core/executive/session.h"
#include "core/scheduler/trial.h"

namespace armloom {

class TaskPreview;
struct TimelineView;

// What-if questions of clients, and views that are made on request. Changes nothing. Used on the
// strand.
class Inquiries {
 public:
  // What the questions are about; all outlive this object.
  struct Asked {
    CellPtr cell;
    const Scheduler& scheduler;
    const TaskBook& tasks;
    const JobRegister& jobs;
    const LiveScene& scene;
    const JobIntake& intake;
    const LeftTouch& touch_left;
    const Session& clock;
    const Publisher& publisher;
  };
  Inquiries(const Asked& asked, OpenQuestions& questions);

  // Finds what would happen to the job if it were submitted now (Trial). Changes nothing. `done` is
  // called on the strand, at once or later. Of a job with steps, checks each motion in order: from
  // where the step before it ends, with what the arms then hold, while all arms of other jobs are
  // where they are now. Ends with the first that is not free.
  void check(JobRequest request, std::function<void(Result<CheckView>)> done);
  // Plans a trajectory without executing it, around all other arms where they will be after all
  // accepted jobs. Of several candidate arms, plans for the arm that arrives first. The outcome
  // includes the result of check(). `done` is called on the strand, at once or later; soon if the
  // client sets `cancelled`. Problems: wrong names or sizes, broken limits (pointers "/arm",
  // "/to/...", "/start/..."); unavailable: too many plans are open.
  void plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
            std::function<void(Result<PlanOutcome>)> done);
  // Plans all motions of a job with steps without executing them: each from where the step before
  // it ends, with what the arms then hold. Changes nothing. Otherwise like plan() of a motion.
  // Problems: those of submit(); unavailable: too many plans are open.
  void plan(StepsInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
            std::function<void(Result<StepsPlan>)> done);
  // Draws the coordination diagram of two jobs, active or ended. `done` is called on the strand, at
  // once or later. Problems: not_found; invalid: the jobs do not have two different arms;
  // unavailable: too many drawings are open. The pointer "?with" means `key_b`.
  void diagram(const std::string& key_a, const std::string& key_b,
               std::function<void(Result<DiagramView>)> done);
  // Returns the job's motion; null if the job is unknown. If the arm is undecided, returns the
  // motion of the likeliest arm.
  [[nodiscard]] TrajectoryPtr trajectory(const std::string& key) const;
  [[nodiscard]] TimelineView timeline() const;

 private:
  struct OpenInquiry;
  void plan_next(const std::shared_ptr<OpenInquiry>& inquiry);
  using TrialEnd = Result<Trial::Outcome>;
  // Answers the questions of the trial in this scene.
  void walk(std::shared_ptr<Trial> trial, PlanningScenePtr scene,
            std::function<void(TrialEnd)> done);
  [[nodiscard]] Trial::Open open_now() const;
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

  CellPtr cell_;
  const Scheduler& scheduler_;
  const TaskBook& tasks_;
  const JobRegister& jobs_;
  const LiveScene& scene_;
  const JobIntake& intake_;
  const LeftTouch& touch_left_;
  const Session& clock_;
  const Publisher& publisher_;
  OpenQuestions& questions_;
};

// Returns the problem that too many questions of clients ("checks", "plans") are open.
[[nodiscard]] Problem too_many_open(const std::string& what);

}  // namespace armloom
