#pragma once

#include <string>

#include "core/planning/tool_reach.h"

namespace armloom {

// Returns an SVG with two views of the reach, from above (x to the right, y up) and from the side
// (x, z). Each arm has a color, darker where it reaches more of a column. Positions reached by two
// or more arms are framed. A circle marks each arm's first joint.
[[nodiscard]] std::string reach_picture(const ToolReach& reach, const Cell& cell);

}  // namespace armloom
