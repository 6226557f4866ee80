#pragma once

#include <vector>

#include "core/coordination/motion.h"
#include "core/jobs/state.h"

namespace armloom {

// Returns the question to geometry about these steps, against all admitted motions at their present
// progress.
[[nodiscard]] Question question_now(const State& state, const std::vector<StepId>& candidates);
// Returns a question about this job without any other motion, as if its arms were at its start.
[[nodiscard]] Question question_by_itself(const State& state, const Step& step);
// Returns the job's Motion::off_path: how far its arms are off the start of its path (largest
// joint, rad or m). Zero within the tracking error.
[[nodiscard]] double off_path_of(const State& state, const Step& step);
// Returns the job's motion as a candidate for passing orders.
[[nodiscard]] CoordinatedMotion as_candidate(const State& state, const Step& step);
// Returns where all joints will be after all admitted jobs. With `job`, the joints of its arm are
// where the jobs before it leave them.
[[nodiscard]] Configuration rest_after_admitted(const State& state, const Step* step = nullptr);
// Adds passages to the question.
void add_passages(Question& question, const std::vector<Passage>& unknown, const State& state);

}  // namespace armloom
