#pragma once

#include <optional>
#include <vector>

#include "core/jobs/transitions.h"

namespace armloom {

// Moves arms to the start of their next job if its client wants that (MoveToStart::plan). Each such
// move-to-start is a slow job of the scheduler with a goal (goals.h), placed before that job in the
// arm queue. If it ends elsewhere (stopped, failed), another one follows, up to kApproachesMax.
// Before any arm moves, the client's job is checked for self-collisions (Admission).
inline constexpr int kApproachesMax = 3;
// Speed of a move-to-start, as a share of the joints' maximum speeds. The cell's
// velocity_scaling_factor is used if it is smaller.
inline constexpr double kApproachSpeed = 0.25;

// Handles jobs at the front of their queues whose arms do not rest at their start: adds a
// move-to-start, changes to an alternative that begins there, or fails the job.
void fail_impossible_starts(Transitions& state);
// Call when the job fails with Reason::deadlock, or fails because an earlier job did. The arms are
// then moved to the start of their next jobs, as with MoveToStart::plan, so that these do not fail
// too.
void keep_those_behind(Transitions& state, const Step& step);
// Returns the first job at the front of its queues that must be checked for self-collisions before
// its arms are moved to its start; nullopt if there is none.
[[nodiscard]] std::optional<JobId> next_in_question(const State& state);
// Returns the job's moves-to-start that have not ended.
[[nodiscard]] std::vector<JobId> approaches_of(const State& state, const Step& step);
// Gives up the job's moves to its start, then the job.
void give_up_with_approaches(Transitions& state, const Step& step, const AfterStop& after);
// Returns the job that this move-to-start is for; nullopt if it is not a move-to-start.
[[nodiscard]] std::optional<JobId> approached_job(const State& state, JobId approach);

}  // namespace armloom
