#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/model/xml/xml_element.h"

namespace armloom {

// What is copied of a URDF's element to the mended one (urdf_check.h), checked on the way. `place`
// tells what is wrong.

// An attribute of `size` finite numbers, written anew: urdfdom knows no white space but blanks.
struct NumbersAttribute {
  const char* name;
  std::size_t size;
  Presence presence;
};
std::optional<std::vector<double>> copy_numbers(const tinyxml2::XMLElement& from,
                                                const NumbersAttribute& attribute,
                                                const XmlPlace& place, tinyxml2::XMLElement& to);

// The same of one that may be absent. Whether it is right, or absent.
bool copy_if_there(const tinyxml2::XMLElement& from, const char* attribute, std::size_t size,
                   const XmlPlace& place, tinyxml2::XMLElement& to);

// The <origin> of `parent`, if it has one. Whether it is right, or absent.
bool copy_origin(const tinyxml2::XMLElement& parent, const XmlPlace& place,
                 tinyxml2::XMLElement& to);

// Warns of what lies farther than any robot reaches: millimetres that were taken for metres.
void warn_if_far(double length_m, const std::string& what, const XmlPlace& place);

[[nodiscard]] double norm_of(const std::vector<double>& v);  // of 3 numbers

}  // namespace armloom
