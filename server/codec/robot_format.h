#pragma once

#include <string>

#include "core/model/cell_description.h"
#include "server/codec/format.h"

namespace armloom {

// Describes a robot and its arms in a cell file (cell_format.h).
[[nodiscard]] FormatPtr<RobotDescription> robot_format();

// Describes ControllerDescription::type.
[[nodiscard]] FormatPtr<std::string> controller_type_format();

}  // namespace armloom
