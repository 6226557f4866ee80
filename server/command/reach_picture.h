#pragma once

#include <string>

#include "core/planning/tool_reach.h"

namespace armloom {

// Returns an SVG with two views: from above (x, y) and from the side (x, z). Each arm has a color,
// which is darker where the arm reaches more positions behind each other. Positions that several
// arms reach are framed. A circle marks the first joint of each arm.
[[nodiscard]] std::string reach_picture(const ToolReach& reach, const Cell& cell);

}  // namespace armloom
