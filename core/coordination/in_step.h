#pragma once

#include "core/base/time.h"

namespace armloom {

// The arms of one synchronous motion keep together on its path: one that gets ahead of another by
// more than kOutOfStep is told to wait there. So they are apart by no more than this, what the one
// ahead passes until it is told, and its stopping reach. Trajectory time.
inline constexpr Duration kOutOfStep = std::chrono::milliseconds(50);
inline constexpr Duration kUntilTold = std::chrono::milliseconds(2);  // control cycles

}  // namespace armloom
