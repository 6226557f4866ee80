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
// path passes the whole region on one side: either A is first (B enters no box before A has left
// it), or B is.
struct ConflictRegion {
  std::vector<ProgressBox> boxes;  // never empty
  Proximity proximity;             // evidence: the closest pair found; body_a belongs to A
  Duration time_a;                 // state in which `proximity` was found
  Duration time_b;
};

// Conflict regions of a candidate and another motion or resting arm. Every state from the
// question's progress on and outside the boxes is certified free, with tracking errors included.
struct PairRegions {
  StepId a;                       // a candidate
  std::variant<StepId, ArmId> b;  // another motion, or a resting arm: its times are zero
  std::vector<ConflictRegion> regions;
};

}  // namespace armloom
