#pragma once

#include <optional>
#include <string>

#include "core/jobs/transitions.h"

namespace armloom {

// Compares an arm at rest with the path on which its job rests. Call when the arm has come to rest,
// was located, or was resumed; does nothing while the arm is stopped. If it is farther from its
// path than start_tolerance_rad, the job is replanned (MoveToStart::plan, or a goal) or fails with
// Reason::start_mismatch. Otherwise its motion will be certified for the arm's distance, and loses
// passing orders that were made for a smaller distance.
void rejoin(Transitions& state, ArmId arm);
// Motions that wait for the arm's rest get new orders. Call when the arm was found elsewhere.
void decide_again_beside(Transitions& state, ArmId arm);
// Returns a sentence if an arm of the job rests farther from the job's path than
// start_tolerance_rad; nullopt if not, or if the job has not moved.
[[nodiscard]] std::optional<std::string> rest_beside_path(const State& state, const Step& step);

}  // namespace armloom
