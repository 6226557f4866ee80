#pragma once

#include <optional>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"
#include "core/model/urdf/urdf_check.h"

namespace armloom {

// Parses a mended robot (urdf_check.h) with urdfdom. Links are in depth-first order, children in
// the order of their joints' names. RobotTree::text stays empty. Returns nullopt, with urdfdom's
// message in `diagnostics`, if urdfdom refuses or drops any part. Thread-safe.
[[nodiscard]] std::optional<RobotTree> read_with_urdfdom(const tinyxml2::XMLElement& mended,
                                                         const std::string& file, UrdfNotes notes,
                                                         Diagnostics& diagnostics);

}  // namespace armloom
