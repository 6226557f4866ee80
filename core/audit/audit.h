#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/model/cell.h"

namespace armloom {

// One recorded instant: measured positions of all joints of the cell.
struct RecordedState {
  TimePoint time;
  Configuration q;
  bool after_rest = false;  // nothing has moved since the one before it
};

struct AuditFinding {
  TimePoint time;
  std::string body_a;
  std::string body_b;
  double distance_m;  // zero in contact
};

struct AuditReport {
  std::optional<AuditFinding> first_contact;
  std::optional<AuditFinding> smallest_clearance;  // over all pairs that are not allowed to touch
  std::size_t states_checked = 0;
};

// Re-checks what really happened with plain FCL, sharing nothing with the admission path beyond the
// model: its own FCL objects, one per collision element as the URDF has it. Between two recorded
// states joints are interpolated linearly so that no step is longer than `step`, but for stretches
// of rest. Arms against each other and against the scene, static links included, count for the
// smallest clearance; what is one arm's own (Cell::is_own) for contact only.
// Precondition: every q has one entry per joint of the cell; times increase.
[[nodiscard]] Result<AuditReport> audit(const Cell& cell, const std::vector<RecordedState>& states,
                                        Duration step);

}  // namespace armloom
