#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/executive/arm_faults.h"
#include "core/executive/authority_gate.h"
#include "core/executive/executive.h"
#include "core/executive/motions.h"
#include "core/executive/start_gate.h"
#include "core/jobs/job.h"

namespace armloom {

// The arms' side: what they are told, as far as it is on disk that they may move and as far as the
// guard allows, what they say, and what is wrong with them.
class Execution {
 public:
  struct Made {
    std::vector<std::unique_ptr<FaultyArm>> arms;  // at home
    SceneFingerprint scene;
  };
  // `log` outlives it; null: nobody asks.
  Execution(const CellPtr& cell, Made made, StartLog* log, ArmFaults::Asked asked,
            AuthorityGate::Calls calls);

  // `written`: told, on the strand, when it is on disk that the job's arms may move; whether it is
  // in motion still.
  void carry_out(const Dispatch& dispatch, const Job& job, std::function<bool(JobId)> written);
  void carry_out(const Grant& grant);
  void carry_out(const Brake& brake) { gate_.brake(brake.job); }
  void carry_out(const Release& release) { gate_.release(release.job); }
  void brake_all() { motions_.brake_all(); }  // whatever moves
  void forget(const Job& ended);

  // One control cycle of every arm. Returns what there is to tell the scheduler, in order of jobs;
  // but for those that it is to know nothing of: the job has not begun.
  [[nodiscard]] const std::vector<MotionReport>& tick(TimePoint now) { return gate_.tick(now); }
  [[nodiscard]] bool keeps_back(const MotionReport& report) const;
  // The arms' own part of it: what goes on if nobody asks any more.
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
