#pragma once

#include <vector>

#include "core/coordination/diagram.h"

namespace armloom {

// The same cells in fewer rectangles: what holds in neighbours holds in their union. A conflict is
// proven in small cells only, but most of it can be told in large ones. `diagram` has the
// durations.
[[nodiscard]] std::vector<DiagramCell> joined(std::vector<DiagramCell> cells,
                                              const Diagram& diagram);

}  // namespace armloom
