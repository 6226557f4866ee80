#pragma once

#include <cstddef>
#include <string>

#include "core/model/findings.h"

namespace tinyxml2 {
class XMLElement;
}

namespace armloom {

// A robot has at most this many links: pairs of links are stored and checked.
inline constexpr std::size_t kMaxLinksOfRobot = 1000;

// What urdfdom forgives, drops or guesses and a robot must not: every number is finite and
// complete, every collision shape is one that is known, with positive size; nothing is misspelt,
// doubled or missing. `file` begins each place.
void check_urdf_elements(const tinyxml2::XMLElement& robot, const std::string& file,
                         Findings& findings);

// Names are unique, joints connect known links, all links hang in one tree under one root, and a
// mimic joint follows a movable joint that is no mimic.
void check_urdf_tree(const tinyxml2::XMLElement& robot, const std::string& file,
                     Findings& findings);

}  // namespace armloom
