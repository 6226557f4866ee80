#pragma once

#include "core/collision/state/clearance_query.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers a Question by the paper's discrete check. Places all candidates and others at equal
// instants: every `method.step` from the question's instant until the last motion rests, both ends
// included. Checks each combined state with the cell's clearance_m (self_clearance_m of an arm from
// itself, mount_clearance_m from its mount). Candidates are checked against everything, but others
// are not checked among themselves. So rests before, between and after motions are covered, and
// only the *remaining* motion of others. Between the instants nothing is checked: collisions there
// are not detected.
//
// A pair that is too close at the first instant may part if the question permits it (may_part);
// otherwise it is a conflict. A parting pair is no conflict while it never comes closer than at the
// first instant, until it has cleared. If the depth of a contact is unknown (flat cylinders, box
// against box), it is taken as zero, so such a pair may stay in contact.
//
// Counterparts are another job, an arm at rest, an object or static link (With::scene), and the
// candidate's own links (With::self; also the other arms of the same synchronous motion). Stops at
// the first instant with a conflict. Reports each counterpart of that instant, with its closest
// pair. Two candidates in conflict are reported once, with the one named first as the candidate.
//
// A motion that stays (Motion::Stands) rests at its progress. If motions may stay, both cases are
// checked, and both must be free.
//
// A pair is not checked again if neither side has moved since the last instant. `evaluations`
// counts the checked instants. Deterministic. Preconditions:
// - the method is TimedDiscrete (else throws std::bad_variant_access) with step > 0,
// - `rest` has one entry per joint, and no arm is in two motions (else throws
//   std::invalid_argument).
[[nodiscard]] Verdict timed_discrete_check(const Question& question, ClearanceQuery& query);

}  // namespace armloom
