#pragma once

#include <string>

#include "core/planning/tool_reach.h"

namespace armloom {

// Two views as one SVG, from above (x to the right, y up) and from the side (x, z): where each
// arm's tool gets to, one colour an arm, the darker the more of the column it reaches; what two or
// more reach is framed. A circle where each arm's first joint is.
[[nodiscard]] std::string reach_picture(const ToolReach& reach, const Cell& cell);

}  // namespace armloom
