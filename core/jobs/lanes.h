#pragma once

#include <vector>

#include "core/coordination/verdict.h"
#include "core/jobs/arm_rests.h"
#include "core/jobs/job_book.h"
#include "core/sequence/safe_sequence.h"

namespace armloom {

// The lanes of the arms, as far as they wait: a sequence in which all of it can be done, kept up
// to date with the jobs and with what becomes known of them. What waits in the queue is a leg; what
// is admitted, held on its path or not, will come to its end; what ended elsewhere leaves its arms
// where they stand. Who is stopped will go on: that changes nothing of what can be done in turn.
class Lanes {
 public:
  explicit Lanes(double start_tolerance) : sequence_(start_tolerance) {}

  // A job came, at the end of its lanes or before others; or is in another phase than `before`;
  // or something else has changed what waits.
  void add(const Record& record);
  void follow(const Job& job, const JobPhase& before);
  void renew_later() { is_stale_ = true; }
  void admitted(const std::vector<JobId>& jobs) { sequence_.admitted(jobs); }

  // Whether these may be asked about, or admitted: a sequence of all else remains. Not where jobs
  // are on their paths: they are admitted already.
  [[nodiscard]] SafeSequence::Outlook after(const std::vector<JobId>& jobs, const JobBook& book,
                                            const ArmRests& arms);
  // In the sequence that after() went by last; where that is to be renewed, nothing speaks against.
  [[nodiscard]] bool goes_before(JobId first, JobId other) const {
    return is_stale_ || sequence_.goes_before(first, other);
  }
  // Whether a sequence of what waits has it in it, as far as is known: of its first legs.
  [[nodiscard]] bool has_place(JobId job, const JobBook& book, const ArmRests& arms);
  // Where they are as they were when asked last.
  [[nodiscard]] bool follows_on(JobId job) const { return sequence_.follows_on(job); }
  void renew(const JobBook& book, const ArmRests& arms);

  // Whatever has become of the question since: what legs and places do to each other stays.
  void learn(const std::vector<Passage>& asked, const Verdict& verdict, const JobBook& book);
  // Found in its way when it was judged: an arm that rests without anything admitted.
  void learn_in_the_way(JobId job, ArmId arm, const JobBook& book, const ArmRests& arms);
  void forget_passages() { sequence_.forget_passages(); }

 private:
  SafeSequence sequence_;  // of all that waits in the queue
  bool is_stale_ = true;   // it is otherwise than the sequence knows
};

}  // namespace armloom
