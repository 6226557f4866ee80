#pragma once

#include "core/jobs/transitions.h"

namespace armloom {

// Compares an arm at rest with the path on which its job rests. Call when the arm has come to rest,
// was located, or was resumed; does nothing while the arm is stopped. If it is farther from its
// path than start_tolerance_rad, the job is replanned (MoveToStart::plan, or a goal) or fails with
// Reason::start_mismatch. Otherwise its motion will be certified for the arm's distance, and loses
// passing orders that were made for a smaller distance.
void rejoin(Transitions& state, ArmId arm);

}  // namespace armloom
