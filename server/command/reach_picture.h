#pragma once

#include <string>

#include "core/planning/tool_reach.h"

namespace armloom {

// Returns an SVG with two views, from above (x, y) and from the side (x, z). Arms have colors,
// darker where they reach more of a column. Shared positions are framed; a circle marks each first
// joint.
[[nodiscard]] std::string reach_picture(const ToolReach& reach, const Cell& cell);

}  // namespace armloom
