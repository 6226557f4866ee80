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
  Diagnostics faults;                    // problems for an arm's home, else warnings
};
struct RobotSemantics {
  using JointSet = std::set<std::size_t>;  // in tree order: from base to tip

  std::string file;  // file name as in messages, without folder
  std::string text;
  std::map<std::string, JointSet> groups;                           // independent and held joints
  std::map<std::string, std::map<std::string, NamedState>> states;  // group -> state name -> values
  std::map<std::pair<std::size_t, std::size_t>, int>
      allowed_pairs;                           // links, smaller index first -> line
  std::map<std::size_t, std::string> passive;  // joint without a motor -> place
};

// Reads an SRDF that was loaded from `path`: groups, group states and enabled or disabled
// collisions. Virtual joints are ignored, because the cell file places the base. As in MoveIt,
// elements with unknown names are left out with a warning. Faulty elements that the `used_groups`
// do not need are also left out with a warning. `prefix` is prepended to all joint and link names.
// Returns nullopt, with the reasons in `diagnostics`, if the text is not XML, or if its names lack
// a prefix that the URDF's names have (lacking_prefix.h).
[[nodiscard]] std::optional<RobotSemantics> read_srdf(
    std::string text, const std::filesystem::path& path, const RobotTree& tree,
    const std::set<std::string>& used_groups, const std::string& prefix, Diagnostics& diagnostics);

}  // namespace armloom
