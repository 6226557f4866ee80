#pragma once

#include <vector>

#include "core/audit/audit.h"
#include "server/physics/contact_oracle.h"

namespace armloom::test {

struct RecordedContact {
  TimePoint time;
  BodyContact bodies;
};

// Checks each state of a recording with MuJoCo: all robots and objects of the cell. Returns the
// first contact of each pair of bodies, in order of time. Does not interpolate between states.
[[nodiscard]] std::vector<RecordedContact> find_contacts(const CellPtr& cell,
                                                         const std::vector<RecordedState>& states);

}  // namespace armloom::test
