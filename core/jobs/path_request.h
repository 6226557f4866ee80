#pragma once

#include <cstdint>
#include <optional>

#include "core/base/ids.h"
#include "core/model/cell.h"

namespace armloom {

// The requests for a path (PlanMotion) for one purpose: a goal, a detour, a replan or a retreat. At
// most one is open; the next one may be sent when it is answered (ways/path_requests.h).
struct PathRequest {
  std::optional<std::uint64_t> question = {};  // number of the open question
  // Positions of all arms in the last question. Without entries, no answer is up to date.
  Configuration beside = {};
  Version asked_at = 0;  // version of the last question
  int tries = 0;         // questions since the owner last reset this
};

}  // namespace armloom
