#pragma once

#include "core/base/time.h"

namespace armloom {

// Arms of one synchronous motion keep in step: an arm ahead of another by more than kOutOfStep is
// ordered to wait. So their progress differs by at most the sum of kOutOfStep, kUntilTold (the
// delay of this order) and the stopping reach. All values are trajectory time.
inline constexpr Duration kOutOfStep = std::chrono::milliseconds(50);
inline constexpr Duration kUntilTold = std::chrono::milliseconds(2);  // two control cycles

}  // namespace armloom
