#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/executive/executive.h"
#include "core/executive/job_intake.h"
#include "core/executive/left_touch.h"
#include "core/executive/modules.h"
#include "core/scheduler/trial.h"

namespace armloom {

class TaskPreview;

// Answers the inquiries of clients.
class InquiryDesk final : public Inquiries, Modules {
 public:
  // All arguments outlive this object.
  InquiryDesk(const Modules& modules, const JobIntake& intake, const LeftTouch& touch_left)
      : Modules(modules), intake_(intake), touch_left_(touch_left) {}

  void check(JobRequest request, std::function<void(Result<CheckView>)> done) override;
  void plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
            std::function<void(Result<PlanOutcome>)> done) override;
  void plan(StepsInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
            std::function<void(Result<StepsPlan>)> done) override;
  void diagram(const std::string& key_a, const std::string& key_b,
               std::function<void(Result<DiagramView>)> done) override;
  [[nodiscard]] TrajectoryPtr trajectory(const std::string& key) const override;
  [[nodiscard]] TimelineView timeline() const override;

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

  const JobIntake& intake_;
  const LeftTouch& touch_left_;
};

// Returns the problem that too many questions of clients ("checks", "plans") are open.
[[nodiscard]] Problem too_many_open(const std::string& what);

}  // namespace armloom
