#pragma once

#include "core/base/time.h"

namespace armloom {

// Arms of one synchronous motion keep in step: an arm ahead of another by more than kOutOfStep is
// ordered to wait. So they differ in progress by at most kOutOfStep, plus kUntilTold (delay of the
// order), plus the stopping reach. All in trajectory time.
inline constexpr Duration kOutOfStep = std::chrono::milliseconds(50);
inline constexpr Duration kUntilTold = std::chrono::milliseconds(2);  // control cycles

}  // namespace armloom
