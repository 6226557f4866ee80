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

// What an SRDF says about a robot, with every name resolved. Joints and links are indices into
// RobotTree::links; a joint is the link that it moves.
struct NamedState {
  std::string place;                     // "arm.srdf:12: group_state ready of arm"
  std::map<std::size_t, double> values;  // joint -> rad or m
  std::set<std::size_t> unread;          // joints whose values are none
  Diagnostics
      faults;  // why it can be no home and no goal; problems only of an arm whose home it is
};
struct RobotSemantics {
  using JointSet = std::set<std::size_t>;  // in tree order: from base to tip

  std::string file;  // file name without folder, as places name it
  std::string text;
  std::map<std::string, JointSet> groups;  // independent joints, and those that the cell holds
  std::map<std::string, std::map<std::string, NamedState>> states;  // group -> state name -> values
  std::map<std::pair<std::size_t, std::size_t>, int> allowed_pairs;  // links, smaller first: line
  std::map<std::size_t, std::string> passive;  // joint -> place: the robot has no motor for it
};

// Reads an SRDF that was loaded from `path`. Groups by chain, joints, links and subgroups in any
// order; group states; disable_collisions, disable_default_collisions and enable_collisions.
// Virtual joints are ignored: the cell file places the base. As MoveIt does, leaves out what names
// links, joints or groups that are not there, with a warning; so it does with all that the cell's
// `used_groups` do not need. Nothing, with the reasons in `diagnostics`, when the text is no XML.
[[nodiscard]] std::optional<RobotSemantics> read_srdf(std::string text,
                                                      const std::filesystem::path& path,
                                                      const RobotTree& tree,
                                                      const std::set<std::string>& used_groups,
                                                      Diagnostics& diagnostics);

}  // namespace armloom
