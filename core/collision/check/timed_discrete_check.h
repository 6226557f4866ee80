#pragma once

#include "core/collision/state/clearance_query.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers a Question by the paper's discrete check: all candidates and all others are put where
// they are at equal instants, every `method.step` from the question's instant until the last of
// them has come to rest (both ends included), and each combined state is checked with the cell's
// clearance_m (an arm from itself: self_clearance_m, from its mount: mount_clearance_m): candidates
// against everything (not others among themselves). So a rest before, between and after motions
// counts, and the others' *remaining* motion is what is compared. Between the instants nothing is
// promised.
//
// A pair that is already too close at the first instant may part: it is no conflict as long as it
// never comes closer than it was then, until it has cleared. Where the depth of a contact is
// unknown (flat cylinders, box against box) it counts as zero, so that such a pair may stay in
// contact. Where the question does not let them (may_part), that is a conflict.
//
// Counterparts are another job, an arm at rest, an object or a static link (With::scene), and the
// candidate's own links (With::self; also the other arms of the same synchronous motion). Stops at
// the first instant with a conflict and reports every counterpart of that instant, each with its
// closest pair; two candidates that conflict are reported once, the one that is named first as the
// candidate.
//
// A motion that stays (Motion::Stands) is at rest at its progress; one that may stay is compared
// both ways, and both must be free.
//
// Pairs of which neither side has moved since the last instant are not looked at again;
// `evaluations` counts the instants that were looked at. Deterministic.
// Preconditions (throws std::invalid_argument): the method is TimedDiscrete (throws
// std::bad_variant_access) with step > 0, `rest` has one entry per joint, no arm in
// two motions.
[[nodiscard]] Verdict timed_discrete_check(const Question& question, ClearanceQuery& query);

}  // namespace armloom
