#pragma once

#include <optional>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Moves arms to the start of their next job, if its client wants that (MoveToStart::plan): by the
// scheduler's own slow jobs with a goal (goals.h), each in front of that job. If one ends elsewhere
// (stopped, failed), another one follows, up to kApproachesMax. Before anything moves, the job is
// checked for self-collisions (Admission).
inline constexpr int kApproachesMax = 3;
// Share of the joints' speeds; the cell's share if that is less.
inline constexpr double kApproachSpeed = 0.25;

// Ends waiting jobs at the front of their queues that cannot begin where their arms rest, unless
// the arms are moved there.
void fail_impossible_starts(State& state);
// The job fails with Reason::deadlock, or because of such a job: the next jobs of its arms are
// moved to their start, as with MoveToStart::plan, instead of failing.
void keep_those_behind(State& state, const Record& record);
// Returns the first job at the front of its queues whose feasibility is to be checked, or nullopt.
[[nodiscard]] std::optional<JobId> next_in_question(const State& state);
// Returns the job's moves-to-start that have not ended.
[[nodiscard]] std::vector<JobId> approaches_of(const State& state, const Record& record);
// Returns the job that this move-to-start is for; nullopt if it is not a move-to-start.
[[nodiscard]] std::optional<JobId> approached_job(const State& state, JobId approach);

}  // namespace armloom
