#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// The content of an SRDF, with every name resolved. Joints and links are indices into
// RobotTree::links; a joint has the index of the link that it moves.
struct NamedState {
  std::string place;                     // "arm.srdf:12: group_state ready of arm"
  std::map<std::size_t, double> values;  // joint -> rad or m
  std::set<std::size_t> unread;          // joints with unreadable values
  Diagnostics faults;  // why it cannot be a home or goal; problems only for the home of an arm
};
struct RobotSemantics {
  using JointSet = std::set<std::size_t>;  // in tree order: from base to tip

  std::string file;  // file name without folder, as used in places
  std::string text;
  std::map<std::string, JointSet> groups;  // independent joints, and joints that the cell fixes
  std::map<std::string, std::map<std::string, NamedState>> states;  // group -> state name -> values
  std::map<std::pair<std::size_t, std::size_t>, int>
      allowed_pairs;                           // links, smaller index first -> line
  std::map<std::size_t, std::string> passive;  // joint -> place: the robot has no motor for it
};

// Reads an SRDF that was loaded from `path`: groups (by chain, joints, links and subgroups, in any
// order), group states, disable_collisions, disable_default_collisions and enable_collisions.
// Virtual joints are ignored, because the cell file places the base. As in MoveIt, elements with
// unknown links, joints or groups are left out with a warning; likewise faulty elements that the
// cell's `used_groups` do not need. Returns nullopt, with the reasons in `diagnostics`, if the text
// is not valid XML.
[[nodiscard]] std::optional<RobotSemantics> read_srdf(std::string text,
                                                      const std::filesystem::path& path,
                                                      const RobotTree& tree,
                                                      const std::set<std::string>& used_groups,
                                                      Diagnostics& diagnostics);

}  // namespace armloom
