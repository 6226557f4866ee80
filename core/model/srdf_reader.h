#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/model/findings.h"
#include "core/model/robot_tree.h"

namespace armloom {

// What an SRDF says about a robot, with every name resolved. Joints and links are indices into
// RobotTree::links; a joint is the link that it moves.
struct RobotSemantics {
  using JointSet = std::set<std::size_t>;       // in tree order: from base to tip
  using State = std::map<std::size_t, double>;  // joint -> rad or m

  std::string file;  // file name without folder, as places name it
  std::string text;
  std::map<std::string, JointSet> groups;                       // independent joints only
  std::map<std::string, std::map<std::string, State>> states;   // group -> state name -> values
  std::set<std::pair<std::size_t, std::size_t>> allowed_pairs;  // links, smaller first
};

// Reads an SRDF that was loaded from `path`. Groups by chain, joints, links and subgroups in any
// order; group states, whose values must keep the URDF's limits; disable_collisions,
// disable_default_collisions and enable_collisions. Virtual joints are ignored: the cell file
// places the base. Nothing, with the reasons in `findings`, when a name is unknown or a number is
// none.
[[nodiscard]] std::optional<RobotSemantics> read_srdf(std::string text,
                                                      const std::filesystem::path& path,
                                                      const RobotTree& tree, Findings& findings);

}  // namespace armloom
