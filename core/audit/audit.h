#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/audit/recorded_scene.h"
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
// FCL objects, one per collision element of the URDF.
//
// Joints are interpolated linearly between states, in steps of at most `step`, except during rest.
// A change of the scene is checked at its time, too. Until the first scene, the cell's objects
// hold. Of several scenes with the same time, the last one holds.
//
// Held objects move with their link. They are checked against everything except the hand that holds
// them (hand_of), what that hand also holds, and what Attachment allows. Pairs that a scene allows
// may touch only as long as the scene holds. Pairs of two static bodies are not checked.
//
// The smallest clearance is over all pairs of arms, and of an arm and the scene or a static link;
// held objects are part of their arm. Pairs within one arm (Cell::is_own) are checked only for
// contact.
//
// Preconditions: every q has one entry per joint of the cell; times of states increase; times of
// scenes do not decrease; an arm moves each link that holds an object.
// Problems: a position that is not finite, a mesh that has not been loaded.
[[nodiscard]] Result<AuditReport> audit(const Cell& cell, const std::vector<RecordedState>& states,
                                        Duration step,
                                        const std::vector<RecordedScene>& scenes = {});

}  // namespace armloom
