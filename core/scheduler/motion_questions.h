#pragma once

#include <vector>

#include "core/coordination/motion.h"
#include "core/jobs/state.h"

namespace armloom {

// What geometry is asked, from where things stand now: about these jobs, beside everything else
// that is admitted.
[[nodiscard]] Question question_now(const State& state, const std::vector<JobId>& candidates);
// About this job alone, its arms being where it begins.
[[nodiscard]] Question question_by_itself(const State& state, const Job& job);
// How far the arms of the job are from its path where it sets out: Motion::off_path.
[[nodiscard]] double off_path_of(const State& state, const Record& record);
// A job's motion, to be ordered beside what is admitted.
[[nodiscard]] CoordinatedMotion as_candidate(const Job& job);
// Where all stand when what is admitted has run; and what comes before that job on its arm, if
// given.
[[nodiscard]] Configuration rest_after_admitted(const State& state, const Job* job = nullptr);
// Passages, to be asked besides.
void add_passages(Question& question, const std::vector<Passage>& unknown, const State& state);

}  // namespace armloom
