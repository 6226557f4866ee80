#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "core/coordination/motion.h"
#include "core/executive/motions.h"
#include "core/guard/authority_guard.h"

namespace armloom {

// All commands to the arms pass this gate. It starts, resumes and extends motions as far as the
// guard allows, and requests missing certificates. Refused authority is tried again in each control
// cycle until the guard allows it or the motion is braked.
class AuthorityGate {
 public:
  struct Calls {
    // Certificates are missing: ask this question, and pass the certificates of the answer to
    // certified().
    std::function<void(const Question&)> certify;
    // The guard refuses authority that the scheduler should not have granted. Called once per
    // refusal.
    std::function<void(StepId, const GuardRefusal&)> refused;
    // A refusal reported by `refused` is now allowed.
    std::function<void(StepId)> allowed;
  };
  // `cell` and `motions` outlive this object. All arms are at rest.
  AuthorityGate(CellPtr cell, Motions& motions, SceneFingerprint present, Calls calls);

  // With false (timed_discrete) the gate allows everything. Precondition: no arm has a motion.
  void set_certified(bool certified) { is_certified_ = certified; }

  void take(const std::vector<Certificate>& certificates) { guard_.take(certificates); }
  void certified(const std::vector<Certificate>& certificates);
  void look_at(const SceneFingerprint& present);
  [[nodiscard]] const SceneFingerprint& scene() const { return guard_.scene(); }
  void forget(const TrajectoryPtr& motion) { guard_.forget(motion); }
  void leaves_path(ArmId arm, double distance) { guard_.leaves_path(arm, distance); }
  // Not under timed_discrete.
  [[nodiscard]] bool is_certified() const { return is_certified_; }
  [[nodiscard]] const AuthorityGuard& guard() const { return guard_; }

  void dispatch(const Dispatch& dispatch, const TrajectoryPtr& motion);
  void grant(const Grant& grant);
  void brake(StepId step);
  void release(StepId step);

  // Runs one control cycle of every arm. Returns the reports for the scheduler, in order of steps.
  [[nodiscard]] const std::vector<MotionReport>& tick(TimePoint now);
  // Returns the steps that have been refused authority for kMissing, each one once.
  [[nodiscard]] std::vector<StepId> refused_for_long();

  // Returns the refusal, reported by Calls::refused, that holds the step back; nullopt if there is
  // none.
  [[nodiscard]] std::optional<GuardRefusal> refusal(StepId step) const;
  [[nodiscard]] bool is_idle() const { return kept_.empty(); }
  [[nodiscard]] std::optional<StepId> step_of(ArmId arm) const { return steps_[arm.index()]; }

  // Shortest time between two requests for the missing certificates of one step.
  inline static constexpr Duration kAskAgain = std::chrono::milliseconds(100);
  // A certificate that is still missing after this time and this many answers is reported as a
  // defect of the scheduler.
  inline static constexpr Duration kMissing = std::chrono::seconds(1);
  inline static constexpr int kAnswers = 2;

 private:
  // A view of a dispatched step whose authority is withheld.
  struct Kept {
    TrajectoryPtr motion;
    Duration authority;
    GuardRefusal refusal;
    TimePoint since;
    std::optional<Dispatch> start = {};  // set: the motion is not sent to the arms yet
    bool is_braked = false;
    bool is_reported = false, is_for_long = false;
    TimePoint asks_from = {};  // time of the next request for its certificates
    int answers = 0;

    [[nodiscard]] AuthorityGuard::From from() const {
      return start ? std::optional(start->from_progress) : std::nullopt;
    }
  };
  [[nodiscard]] std::optional<GuardRefusal> passes(const TrajectoryPtr& motion,
                                                   AuthorityGuard::From from, Duration authority);
  void keep(StepId step, Kept kept);
  void see_positions();
  void try_again();
  void ask();
  [[nodiscard]] Question question_about(StepId step, const Kept& kept) const;
  void report(StepId step, Kept& kept);
  [[nodiscard]] MotionReport stopped(StepId step, const Kept& kept) const;

  CellPtr cell_;
  Motions& motions_;
  AuthorityGuard guard_;
  Calls calls_;
  bool is_certified_ = true;
  std::map<StepId, Kept> kept_;
  std::map<StepId, TrajectoryPtr> told_;
  std::vector<std::optional<StepId>> steps_;  // by ArmId
  std::optional<StepId> asked_;               // the step of the open question
  TimePoint now_{};
  std::uint32_t looked_at_ = 0;  // ArmId of the last resting arm whose position was read
  std::vector<MotionReport> reports_;
};

}  // namespace armloom
