#pragma once

#include <vector>

#include "core/coordination/verdict.h"
#include "core/jobs/arm_rests.h"
#include "core/jobs/job_book.h"
#include "core/sequence/safe_sequence.h"

namespace armloom {

// Keeps the safe sequence of waiting jobs up to date. Queued jobs are its legs; admitted and held
// jobs are assumed to reach their ends, whether stopped or not; jobs that ended elsewhere leave
// their arms there.
class Lanes {
 public:
  explicit Lanes(double start_tolerance) : sequence_(start_tolerance) {}

  // Update the sequence: a new job; a job that left phase `before`; any other change.
  void add(const Record& record);
  void follow(const Job& job, const JobPhase& before);
  void renew_later() { is_stale_ = true; }
  void admitted(const std::vector<JobId>& jobs) { sequence_.admitted(jobs); }

  // Returns what remains of the sequence if these jobs are admitted now. No objection if one of
  // them is not queued, because jobs on their path are admitted already.
  [[nodiscard]] SafeSequence::Outlook after(const std::vector<JobId>& jobs, const JobBook& book,
                                            const ArmRests& arms);
  // According to the last after(); true if the sequence must be renewed.
  [[nodiscard]] bool goes_before(JobId first, JobId other) const {
    return is_stale_ || sequence_.goes_before(first, other);
  }
  // True also if not known.
  [[nodiscard]] bool has_place(JobId job, const JobBook& book, const ArmRests& arms);
  // The job begins where the jobs before it leave its arms.
  [[nodiscard]] bool follows_on(JobId job) const { return sequence_.follows_on(job); }
  void renew(const JobBook& book, const ArmRests& arms);

  void learn(const std::vector<Passage>& asked, const Verdict& verdict, const JobBook& book);
  // The resting `arm`, without an admitted job, blocks the job's path.
  void learn_in_the_way(JobId job, ArmId arm, const JobBook& book, const ArmRests& arms);
  void forget_passages() { sequence_.forget_passages(); }

 private:
  SafeSequence sequence_;  // of all queued jobs
  bool is_stale_ = true;
};

}  // namespace armloom
