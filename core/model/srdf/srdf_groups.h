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

// Every group of the SRDF with the joints that it holds: independent ones, and those that the cell
// holds; fixed and mimic joints, which MoveIt lists too, are dropped. As in MoveIt, a link stands
// for the joint above it and a chain for the joints between its base link and its tip link.
// Virtual joints may be named and are ignored. Names that are not there are left out with a
// warning; what else is wrong with a group is a problem if the group is used, or below one that
// is, and else a warning.
[[nodiscard]] std::map<std::string, RobotSemantics::JointSet> read_groups(
    const tinyxml2::XMLElement& srdf, const std::string& file, const RobotTree& tree,
    const GroupNames& names, Diagnostics& diagnostics);

}  // namespace armloom
