#pragma once

#include "core/model/cell_description.h"
#include "server/codec/format.h"

namespace armloom {

// The part of the description of a cell file (cell_format.h) that tells of a robot and its arms.
[[nodiscard]] FormatPtr<RobotDescription> robot_format();

}  // namespace armloom
