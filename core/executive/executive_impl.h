#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/inquiry_desk.h"
#include "core/executive/job_desk.h"
#include "core/executive/job_intake.h"
#include "core/executive/modules.h"
#include "core/executive/task_run.h"
#include "core/executive/watching.h"

namespace armloom {

// The modules of the executive and their connections: every input of the scheduler, and every
// effect, passes here.
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

  void step(const Input& input);
  void tick(TimePoint now);
  void end(const std::string& cause, bool keeps_waiting, std::function<void()> done);
  void stop(const std::vector<ArmId>& arms, const std::string& cause,
            Alert::Level level = Alert::Level::warning,
            StopCategory category = StopCategory::brake);
  std::vector<ArmId> resume(std::vector<ArmId> arms);
  void set_speed(std::optional<ArmId> arm, double share);
  // Limits the speed of arms by what they hold now.
  void set_brakes();
  void pass_on_speed();
  [[nodiscard]] TimePoint settled_until() const;
  void follow_policy();

  // The modules that serve clients.
  struct Clients {
    JobIntake intake;
    TaskRun tasks;
    JobDesk desk;
    InquiryDesk inquiries;
  };

  CellPtr cell_;
  Scheduler scheduler_;
  TaskBook tasks_;
  JobRegister jobs_;
  LiveScene scene_;
  Signals signals_;
  Execution execution_;
  OpenQuestions questions_;
  Session clock_;
  Publisher publisher_;
  ArmWatch watch_;
  Clients clients_;

 private:
  [[nodiscard]] Modules modules();
  [[nodiscard]] std::vector<Effect> decided(const Input& input);
  void carry_out(const Effect& effect);
  void clear_left_touch(const std::vector<Effect>& effects);
  void note_aside(const YieldMove& aside);
  void job_changed(JobId job);
  void show_check();
  void hide_checks();
  void certify(const Question& question);
  void refused(JobId job, const GuardRefusal& refusal);
  void scene_has_changed(ClearanceQuery& query);
  void signal_changed(SignalId signal);
};

}  // namespace armloom
