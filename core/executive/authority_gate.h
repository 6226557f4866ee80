#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "core/coordination/motion.h"
#include "core/executive/motions.h"
#include "core/guard/authority_guard.h"

namespace armloom {

// The only way to the arms: starts, resumes and extends motions as far as the guard allows. What it
// refuses is kept and tried again in each control cycle, until the guard allows it or the motion is
// braked. Certificates that are missing are asked for.
class AuthorityGate {
 public:
  struct Calls {
    // Certificates are missing: the answer's come back through certified().
    std::function<void(const Question&)> certify;
    // The scheduler granted what it should not have: told once for each job.
    std::function<void(JobId, const GuardRefusal&)> refused;
    // What was told so is allowed now.
    std::function<void(JobId)> allowed;
  };
  // Both outlive it. All arms are at rest.
  AuthorityGate(CellPtr cell, Motions& motions, SceneFingerprint present, Calls calls);

  // Without certificates (timed_discrete) everything passes. Precondition: no arm is on a motion.
  void set_certified(bool certified) { is_certified_ = certified; }

  // From answers of the checker, whatever they were asked for.
  void take(const std::vector<Certificate>& certificates) { guard_.take(certificates); }
  // The answer to Calls::certify.
  void certified(const std::vector<Certificate>& certificates);
  void look_at(const SceneFingerprint& present);
  [[nodiscard]] const SceneFingerprint& scene() const { return guard_.scene(); }
  void forget(const TrajectoryPtr& motion) { guard_.forget(motion); }

  void dispatch(const Dispatch& dispatch, const TrajectoryPtr& motion);
  void grant(const Grant& grant);
  void brake(JobId job);
  void release(JobId job);

  // One control cycle of every arm. Returns what there is to tell the scheduler, in order of jobs.
  [[nodiscard]] const std::vector<MotionReport>& tick(TimePoint now);

  // Returns the refusal that the scheduler did not expect and that keeps the job back now; nullopt
  // if there is none.
  [[nodiscard]] std::optional<GuardRefusal> refusal(JobId job) const;
  // Returns true if the arms were told all that was granted.
  [[nodiscard]] bool is_idle() const { return kept_.empty(); }
  // The job whose motion the arm was told of last.
  [[nodiscard]] std::optional<JobId> job_of(ArmId arm) const { return jobs_[arm.index()]; }

  // The gate asks for the missing certificates of one job at most once in this time.
  inline static constexpr Duration kAskAgain = std::chrono::milliseconds(100);
  // A certificate that is missing longer than this, and after so many answers about the present
  // scene, is a defect of the scheduler.
  inline static constexpr Duration kMissing = std::chrono::seconds(1);
  inline static constexpr int kAnswers = 2;

 private:
  struct Kept {
    TrajectoryPtr motion;
    Duration authority;
    GuardRefusal refusal;
    TimePoint since;
    std::optional<Dispatch> start = {};  // the arms are not told yet
    bool is_braked = false;              // before they were
    bool is_reported = false;
    TimePoint asks_from = {};  // the gate asks for its certificates from then on
    int answers = 0;           // about the present scene, without the missing certificate

    [[nodiscard]] AuthorityGuard::From from() const {
      return start ? std::optional(start->from_progress) : std::nullopt;
    }
  };
  [[nodiscard]] std::optional<GuardRefusal> passes(const TrajectoryPtr& motion,
                                                   AuthorityGuard::From from, Duration authority);
  void keep(JobId job, Kept kept);
  void see_positions();
  void try_again();
  void ask();
  [[nodiscard]] Question question_about(JobId job, const Kept& kept) const;
  void report(JobId job, Kept& kept);
  [[nodiscard]] MotionReport stopped(JobId job, const Kept& kept) const;

  CellPtr cell_;
  Motions& motions_;
  AuthorityGuard guard_;
  Calls calls_;
  bool is_certified_ = true;
  std::map<JobId, Kept> kept_;
  std::map<JobId, TrajectoryPtr> told_;     // motions that arms were told of
  std::vector<std::optional<JobId>> jobs_;  // by ArmId
  std::optional<JobId> asked_;              // the job of the open question
  TimePoint now_{};
  std::uint32_t looked_at_ = 0;  // ArmId of the arm at rest that was read last
  std::vector<MotionReport> reports_;
};

}  // namespace armloom
