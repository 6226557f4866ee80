#pragma once

#include <string>
#include <vector>

#include "core/model/cell.h"

namespace armloom {

// An object that hands of several arms hold. These arms move only together: a motion moves all of
// them, or none.
struct SharedHold {
  std::string object;
  std::vector<ArmId> arms;  // ascending

  bool operator==(const SharedHold&) const = default;
};

// Returns a hold of which a motion of the arms `moved` moves some arms, but not all; null if there
// is none.
[[nodiscard]] const SharedHold* hold_broken_by(const std::vector<ArmId>& moved,
                                               const std::vector<SharedHold>& holds);
// Returns true if the arm may not move alone.
[[nodiscard]] bool is_in(ArmId arm, const std::vector<SharedHold>& holds);
// Returns why such a motion is refused or waits, with the remedy.
[[nodiscard]] std::string text_of(const SharedHold& hold, const Cell& cell);

}  // namespace armloom
