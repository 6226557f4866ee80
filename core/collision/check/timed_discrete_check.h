#pragma once

#include "core/collision/state/clearance_query.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers a Question by the paper's discrete check. Collisions between the checked instants are not
// detected.
//
// Instants are `method.step` apart, from the question's instant until the last motion rests, both
// included. At each instant, all candidates and others are placed, and candidates are checked
// against everything. Others are not checked among themselves. The limits are the cell's
// clearance_m, self_clearance_m of an arm from itself, and mount_clearance_m from its mount. So
// rests before and after motions are covered, and what remains of other motions.
//
// If the question permits it (may_part), a pair that is too close at the first instant may move
// apart. This pair is no conflict as long as it never comes closer than at that instant. Once it
// has cleared, it is checked like any other pair. An unknown depth of contact (flat cylinders, box
// against box) is taken as zero, so such a pair may stay in contact.
//
// Stops at the first instant with a conflict, and reports each counterpart with its closest pair.
// Counterparts are
// - another step's motion,
// - an arm at rest,
// - an object or static link (With::scene),
// - the candidate's own links and the other arms of a synchronous motion (With::self).
// Two candidates in conflict are reported once; the candidate that the question names first is
// Conflict::candidate.
//
// A motion that stays (Motion::Stands) rests at its progress. If others may stay, the verdict is
// free only if it is free in both cases.
//
// Pairs are skipped while neither side moves; `evaluations` counts checked instants. Deterministic.
// Preconditions:
// - the method is TimedDiscrete (else throws std::bad_variant_access)
// - step > 0, `rest` has one entry per joint, no arm is in two motions (else throws
//   std::invalid_argument)
[[nodiscard]] Verdict timed_discrete_check(const Question& question, ClearanceQuery& query);

}  // namespace armloom
