#pragma once

#include <set>
#include <vector>

#include "core/coordination/verdict.h"
#include "core/jobs/arm_rests.h"
#include "core/jobs/job_book.h"
#include "core/sequence/safe_sequence.h"

namespace armloom {

// Keeps the safe sequence (safe_sequence.h) of the waiting steps up to date. Its legs are the steps
// of queued jobs. Admitted, braking and held jobs are assumed to reach their ends, even if they are
// stopped now. An arm whose job ended elsewhere is assumed to stay there.
class Lanes {
 public:
  explicit Lanes(double start_tolerance) : sequence_(start_tolerance) {}
  // A copy is independent. Not assignable: only the transitions change the sequence.
  Lanes(const Lanes&) = default;
  Lanes(Lanes&&) = default;

  // Marks the sequence as out of date, because paths or places have changed.
  void renew_later() { is_stale_ = true; }

  // Returns what remains of the sequence if these steps are admitted now. There is no objection if
  // one of them is not queued: the sequence already counts with the end of a step on its path.
  [[nodiscard]] SafeSequence::Outlook after(const std::vector<StepId>& steps, const JobBook& book,
                                            const ArmRests& arms);
  // Returns true if `first` precedes `other` in the sequence, or if the sequence must be renewed
  // first.
  [[nodiscard]] bool goes_before(StepId first, StepId other) const {
    return is_stale_ || sequence_.goes_before(first, other);
  }
  [[nodiscard]] JobId newest() const { return sequence_.newest(); }
  // Returns true if the step is in the sequence, or is none of its legs.
  [[nodiscard]] bool has_place(StepId step, const JobBook& book, const ArmRests& arms);
  // Returns true if the step begins where the steps before it leave its arms.
  [[nodiscard]] bool follows_on(StepId step) const { return sequence_.follows_on(step); }
  void renew(const JobBook& book, const ArmRests& arms);

  void learn(const std::vector<Passage>& asked, const Verdict& verdict, const JobBook& book);
  // A check found that `arm` at its rest blocks the step's path. Ignored if the arm has a step
  // that is admitted or on its path.
  void learn_in_the_way(StepId step, ArmId arm, const PassageBlock& block, const JobBook& book,
                        const ArmRests& arms);

 private:
  friend class StateWriter;
  friend class Transitions;

  Lanes& operator=(Lanes&&) = default;
  // Update the sequence after a new job, and after a job that left phase `before`.
  void add(const Step& step, const JobBook& book);
  void follow(const Step& step, const StepPhase& before);
  // Records that the steps of the last after() call were admitted.
  void admitted(const std::vector<StepId>& steps) { sequence_.admitted(steps); }
  void forget_passages() { sequence_.forget_passages(); }

  // Returns true if the step is behind one that is left out, on one of its arms.
  [[nodiscard]] bool is_left_out(const Step& step) const;

  SafeSequence sequence_;  // of the steps of all queued jobs
  // Arms whose further steps are in no sequence, because they come after a step of other arms whose
  // end is not known yet: a place before that step would be wrong.
  std::set<ArmId> left_out_;
  bool is_stale_ = true;
};

}  // namespace armloom
