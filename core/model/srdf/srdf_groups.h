#pragma once

#include <map>
#include <set>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/srdf/srdf_reader.h"
#include "core/model/urdf/robot_tree.h"

namespace tinyxml2 {
class XMLElement;
}

namespace armloom {

struct GroupNames {
  const std::set<std::string>& virtual_joints;
  const std::set<std::string>& used;
};

// Returns every group of the SRDF with its independent and held joints. As in MoveIt, a link
// denotes the joint above it, and a chain the joints between its base link and its tip link.
// Virtual joints are ignored. Unknown names are left out with a warning. Other faults are problems
// in used groups and groups below them, and warnings elsewhere.
[[nodiscard]] std::map<std::string, RobotSemantics::JointSet> read_groups(
    const tinyxml2::XMLElement& srdf, const std::string& file, const RobotTree& tree,
    const GroupNames& names, Diagnostics& diagnostics);

}  // namespace armloom
