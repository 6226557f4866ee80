#pragma once

#include <optional>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"
#include "core/model/urdf/urdf_check.h"

namespace armloom {

// Parses a mended robot (urdf_check.h) with urdfdom: links depth first, children in the order of
// their joints' names, without text. Returns nullopt, with urdfdom's message in `diagnostics`, if
// urdfdom refuses or drops any part. Threads: any.
[[nodiscard]] std::optional<RobotTree> read_with_urdfdom(const tinyxml2::XMLElement& mended,
                                                         const std::string& file, UrdfNotes notes,
                                                         Diagnostics& diagnostics);

}  // namespace armloom
