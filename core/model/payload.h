#pragma once

#include <optional>
#include <span>

#include "core/base/ids.h"
#include "core/base/problem.h"
#include "core/model/attachment.h"
#include "core/model/cell.h"

namespace armloom {

// Functions that count what an arm carries as its payload (PayloadDescription).

// Returns the mass of the objects that the arm holds (kg), each times the lever of its center of
// mass if that is beyond PayloadDescription::lever_m. Objects that several arms hold count in full
// for each: any of them may bear the load. Zero if the arm states no payload.
[[nodiscard]] double counted_mass(const Cell& cell, ArmId arm, std::span<const Attachment> held);

// Returns the share of its limits of brake and acceleration that the arm keeps with these objects:
// 1 with empty hands, falling in proportion to the counted mass down to brake_at_max.
//
// An arm that keeps the share b takes the same distance to stop from the rate sqrt(b) as one with
// empty hands from the planned rate. So an arm goes at sqrt(b) at most, and every certificate and
// authority holds unchanged: they are about positions, not about times.
[[nodiscard]] double kept_brake(const Cell& cell, ArmId arm, std::span<const Attachment> held);

// Returns why the arm may not carry these objects: "too-heavy", or "payload-unknown" if one of them
// has a mass and the arm states no payload.
[[nodiscard]] std::optional<Problem> find_overload(const Cell& cell, ArmId arm,
                                                   std::span<const Attachment> held);

}  // namespace armloom
