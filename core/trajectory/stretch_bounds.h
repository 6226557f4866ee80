#pragma once

#include "core/trajectory/trajectory.h"

namespace armloom {

// Of the part of a segment from `from_s` to `to_s` after it begins: the tighter the shorter that
// is. Sound but for rounding (1e-12). Precondition: from_s <= to_s.
[[nodiscard]] SegmentBounds bounds_of(const Segment& segment, double from_s, double to_s);

}  // namespace armloom
