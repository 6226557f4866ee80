#pragma once

#include <optional>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Arms that stand elsewhere than where the next job of theirs begins, and that this job wants to be
// brought there (MoveToStart::plan): by jobs of the scheduler's own that say where to go
// (goals.h), slowly, each in front of that job. Where one comes to an end elsewhere (it was
// stopped, has failed), another one follows, so many in all. Nothing moves for a job that would hit
// itself on its way: whether it does is asked first (Admission).
inline constexpr int kApproachesMax = 3;
// Share of the joints' speeds; the cell's where that is less.
inline constexpr double kApproachSpeed = 0.25;

// A job at the head of its arms that cannot begin where they stand, and where they are not brought,
// will never be able to: ends those that wait there.
void fail_impossible_starts(State& state);
// This job fails with Reason::deadlock, or for such a one: the next jobs of its arms do not fail
// for that, but are brought to where they begin as with MoveToStart::plan.
void keep_those_behind(State& state, const Record& record);
// The first of its arms of which that is to be asked.
[[nodiscard]] std::optional<JobId> next_in_question(const State& state);
// Those that have not ended.
[[nodiscard]] std::vector<JobId> approaches_of(const State& state, const Record& record);
// Returns the job whose arms this one brings to their start; nullopt if it is no approach.
[[nodiscard]] std::optional<JobId> approached_job(const State& state, JobId approach);

}  // namespace armloom
