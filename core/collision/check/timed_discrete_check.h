#pragma once

#include "core/collision/state/clearance_query.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers a Question by the paper's discrete check. Places all candidates and others at instants
// every `method.step`, from the question's instant until the last motion rests, both included.
// Checks candidates against everything, but not others among themselves, with the cell's
// clearance_m (self_clearance_m of an arm from itself, mount_clearance_m from its mount). So rests
// before, between and after motions are covered, and the *remaining* motion of others. Collisions
// between the instants are not detected.
//
// If the question permits (may_part), a pair that is too close at the first instant may part. It is
// no conflict while it never comes closer than then, until it has cleared. An unknown depth of
// contact (flat cylinders, box against box) is taken as zero, so such a pair may stay in contact.
//
// Counterparts are another job, an arm at rest, an object or static link (With::scene), and the
// candidate's own links (With::self; also the other arms of a synchronous motion). Stops at the
// first instant with a conflict and reports each counterpart with its closest pair. Two candidates
// in conflict are reported once, the first named as the candidate.
//
// A motion that stays (Motion::Stands) rests at its progress. If a motion may stay, both cases must
// be free.
//
// Pairs are skipped while neither side moves; `evaluations` counts checked instants. Deterministic.
// Preconditions: the method is TimedDiscrete (throws std::bad_variant_access) with step > 0, `rest`
// has one entry per joint, no arm is in two motions (throws std::invalid_argument).
[[nodiscard]] Verdict timed_discrete_check(const Question& question, ClearanceQuery& query);

}  // namespace armloom
