#pragma once

#include <vector>

#include "core/coordination/motion.h"
#include "core/jobs/state.h"

namespace armloom {

// What geometry is asked, from where things stand now: about these jobs, beside everything else
// that is admitted.
[[nodiscard]] Question question_now(const State& state, const std::vector<JobId>& candidates);
// A job's motion, to be ordered beside what is admitted.
[[nodiscard]] CoordinatedMotion as_candidate(const Job& job);
// Passages, to be asked besides.
void add_passages(Question& question, const std::vector<Passage>& unknown, const JobBook& jobs);

}  // namespace armloom
