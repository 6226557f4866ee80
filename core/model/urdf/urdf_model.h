#pragma once

#include <optional>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"
#include "core/model/urdf/urdf_check.h"

namespace armloom {

// Has urdfdom read a mended robot (urdf_check.h), and takes its model over: links depth first,
// children by their joints' names; without text. Nothing, with urdfdom's words in `diagnostics`,
// when it refuses the robot or any part of it. Threads: any.
[[nodiscard]] std::optional<RobotTree> read_with_urdfdom(const tinyxml2::XMLElement& mended,
                                                         const std::string& file, UrdfNotes notes,
                                                         Diagnostics& diagnostics);

}  // namespace armloom
