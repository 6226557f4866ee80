#pragma once

#include <set>
#include <string>

namespace tinyxml2 {
class XMLElement;
}

namespace armloom {

// The joint and link names in an SRDF, each where an attribute gives one. Virtual joints are not
// included, because the URDF does not have them.
struct SrdfNames {
  std::set<std::string> links;
  std::set<std::string> joints;
};
[[nodiscard]] SrdfNames names_in_srdf(const tinyxml2::XMLElement& srdf);

// Prepends `prefix` to all these names.
void prepend_to_names(const std::string& prefix, tinyxml2::XMLElement& srdf);

}  // namespace armloom
