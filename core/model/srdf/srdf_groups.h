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

// Returns, for every group of the SRDF, its independent joints and its fixed joints
// (TreeJoint::held). As in MoveIt, a link in a group means the joint above the link. A chain means
// the joints between its base link and its tip link. Virtual joints are ignored. Unknown names are
// left out with a warning. Other faults are problems in groups that the cell uses and in their
// subgroups, and warnings elsewhere.
[[nodiscard]] std::map<std::string, RobotSemantics::JointSet> read_groups(
    const tinyxml2::XMLElement& srdf, const std::string& file, const RobotTree& tree,
    const GroupNames& names, Diagnostics& diagnostics);

}  // namespace armloom
