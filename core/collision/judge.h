#pragma once

#include "core/collision/collision_checker.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers a Question by the paper's discrete check: all candidates and all others are put where
// they are at equal instants, every `method.step` from the question's instant until the last of
// them has come to rest (both ends included), and each combined state is checked with the cell's
// clearance_m (an arm's own links: self_clearance_m): candidates against everything (not others among themselves). So a rest before, between and after
// motions counts, and the others' *remaining* motion is what is compared.
// A pair that is already closer than clearance_m at the first instant may part: it is no conflict
// as long as it never comes closer than it was, until it has cleared.
// Returns the first conflict in time with each counterpart: another job, an arm at rest, an object or
// another robot's static link (With::scene), the candidate itself and its robot's static links. Stops
// at the first instant in which one was found (all counterparts of that instant are reported, each
// with its closest pair; two candidates that conflict are reported once, with the one that is named
// first as the candidate). Pairs of which neither side has moved since the last instant are not
// looked at again; `evaluations` counts the instants that were looked at. Deterministic.
// Where the depth of a contact is unknown (flat cylinders, box against box) it counts as zero, so
// that such a pair in contact at the first instant may stay in contact.
// Preconditions (throws std::invalid_argument): step > 0, `rest` has one entry per joint, no arm in
// two motions.
[[nodiscard]] Verdict judge(const Question& question, CollisionChecker& checker);

}  // namespace armloom
