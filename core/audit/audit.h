#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/model/cell.h"

namespace armloom {

// Measured positions of all joints of the cell.
struct RecordedState {
  TimePoint time;
  Configuration q;
  bool after_rest = false;  // no joint has moved since the previous state
};

struct AuditFinding {
  TimePoint time;
  std::string body_a;
  std::string body_b;
  double distance_m;  // zero in contact
};

struct AuditReport {
  std::optional<AuditFinding> first_contact;
  std::optional<AuditFinding> smallest_clearance;  // over all pairs except those within one arm
  std::size_t states_checked = 0;
};

// Re-checks recorded states with plain FCL. Shares only the model with admission: it has its own
// FCL objects, one per collision element of the URDF. Joints are interpolated linearly between
// states, in steps of at most `step`, except during rest. The smallest clearance is over all pairs
// of arms, and of an arm and the scene or a static link. Pairs within one arm (Cell::is_own) are
// checked only for contact. Precondition: every q has one entry per joint of the cell; times
// increase.
[[nodiscard]] Result<AuditReport> audit(const Cell& cell, const std::vector<RecordedState>& states,
                                        Duration step);

}  // namespace armloom
