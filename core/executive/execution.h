#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/executive/arm_faults.h"
#include "core/executive/authority_gate.h"
#include "core/executive/executive.h"
#include "core/executive/motions.h"
#include "core/executive/start_gate.h"
#include "core/jobs/step.h"

namespace armloom {

// Carries out the scheduler's effects on the arms. A command is withheld until the job's start is
// on disk and the guard allows the command.
class Execution {
 public:
  struct Made {
    std::vector<MadeController> arms;  // by ArmId
    SceneFingerprint scene;
  };
  // `log` outlives this object; may be null.
  Execution(const CellPtr& cell, Made made, StartLog* log, ArmFaults::Asked asked,
            AuthorityGate::Calls calls);

  // `written` is called on the strand when the job's start is on disk; it returns true if the job
  // is still in motion.
  void carry_out(const Dispatch& dispatch, const Step& step, std::function<bool(StepId)> written);
  // Returns true if it is on disk that the job has begun. If it is not, asks for that once, and
  // calls `written` later.
  [[nodiscard]] bool record_start(JobId job, std::function<void(JobId)> written);
  void carry_out(const Grant& grant);
  void carry_out(const Brake& brake) { gate_.brake(brake.step); }
  void carry_out(const Release& release) { gate_.release(release.step); }
  void brake(ArmId arm, StopCategory category = StopCategory::brake) {
    motions_.brake(arm, category);
  }
  void brake_all() { motions_.brake_all(); }
  void set_speed(std::vector<ArmCommand::SetSpeed> speeds) {
    motions_.set_speed(std::move(speeds));
  }
  void forget(const Step& ended);

  // Runs one control cycle of every arm. Returns the reports for the scheduler, in order of steps.
  // A report for which keeps_back() is true must not be passed on, because the job's start is not
  // recorded.
  [[nodiscard]] const std::vector<MotionReport>& tick(TimePoint now) { return gate_.tick(now); }
  [[nodiscard]] bool keeps_back(const MotionReport& report) const;
  // Runs the arms only, as if the executive had stopped.
  void tick_arms(TimePoint now) { motions_.tick_arms(now); }

  [[nodiscard]] const Motions& motions() const { return motions_; }
  [[nodiscard]] AuthorityGate& gate() { return gate_; }
  [[nodiscard]] const AuthorityGate& gate() const { return gate_; }
  [[nodiscard]] const StartGate& starts() const { return starts_; }
  [[nodiscard]] ArmFaults& faults() { return faults_; }

 private:
  ArmFaults faults_;
  Motions motions_;
  AuthorityGate gate_;
  StartGate starts_;
};

}  // namespace armloom
