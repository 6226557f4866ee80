#pragma once

#include <vector>

#include "core/coordination/motion.h"
#include "core/jobs/state.h"

namespace armloom {

// Returns the question to geometry about these jobs, against all admitted motions at their present
// progress.
[[nodiscard]] Question question_now(const State& state, const std::vector<JobId>& candidates);
// Returns a question about this job alone, with its arms at its start.
[[nodiscard]] Question question_by_itself(const State& state, const Job& job);
// Returns the distance of the job's arms from the start of its path: Motion::off_path.
[[nodiscard]] double off_path_of(const State& state, const Record& record);
// Returns the job's motion as a candidate for passing orders.
[[nodiscard]] CoordinatedMotion as_candidate(const Job& job);
// Returns the positions of all arms after all admitted jobs, and, with `job`, after the jobs before
// it on its arm.
[[nodiscard]] Configuration rest_after_admitted(const State& state, const Job* job = nullptr);
// Adds passages to the question.
void add_passages(Question& question, const std::vector<Passage>& unknown, const State& state);

}  // namespace armloom
