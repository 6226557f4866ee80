#pragma once

#include "core/collision/collision_checker.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers a Question by the paper's discrete check: all candidates and all others are put where
// they are at equal instants, every `method.step` from the question's instant until the last of
// them has come to rest (both ends included), and each combined state is checked with the cell's
// clearance_m: candidates against everything (not others among themselves). So a rest before, between and after
// motions counts, and the others' *remaining* motion is what is compared.
// A pair that is already closer than clearance_m at the first instant may part: it is no conflict
// as long as it never comes closer than it was, until it has cleared.
// Returns the first conflict in time with each counterpart. Stops at the first instant in which one
// was found (all conflicts of that instant are reported). Deterministic.
[[nodiscard]] Verdict judge(const Question& question, CollisionChecker& checker);

}  // namespace armloom
