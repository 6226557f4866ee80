#pragma once

#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/proximity.h"

namespace armloom {

// A closed rectangle of a coordination diagram: trajectory times of A and of B.
struct ProgressBox {
  Duration from_a, to_a, from_b, to_b;
};

// A connected set of states (progress of A, progress of B) that are not certified free. A monotone
// path through the diagram passes all of it on one side: either A is first everywhere (B comes to
// no box before A has left it), or B is.
struct ConflictRegion {
  std::vector<ProgressBox> boxes;  // never empty
  Proximity proximity;             // evidence: the closest that was found; body_a is A's
  Duration time_a;                 // where
  Duration time_b;
};

// What a candidate and another motion, or an arm at rest, do to each other wherever each is on its
// way. Every state outside of the boxes, from the progress that the question gave on, is certified
// free: in it both keep the cell's clearance, their tracking errors included.
struct PairRegions {
  JobId a;                       // a candidate
  std::variant<JobId, ArmId> b;  // another motion, or an arm that none moves: its times are zero
  std::vector<ConflictRegion> regions;
};

}  // namespace armloom
