#pragma once

#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Returns where every joint will be when all accepted jobs have succeeded (rad, m), or where the
// arm comes to rest if its last job is being canceled. A new job must begin there.
[[nodiscard]] Configuration predicted_rest(const State& state);
// Returns the arms for which predicted_rest() is an estimate, because the arm's last goal is a
// pose without a plan, because a job may still go to this arm or to another one, or because the
// arm brakes and its controller has not told where it will rest.
[[nodiscard]] std::vector<ArmId> open_ends(const State& state);

}  // namespace armloom
