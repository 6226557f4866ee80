#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/model/xml/xml_element.h"

namespace armloom {

// These functions copy parts of a URDF to the mended URDF (urdf_check.h). They report faults at
// `place`.

// Copies `size` finite numbers, separated by spaces, as urdfdom requires. Returns nullopt if faulty
// or missing.
struct NumbersAttribute {
  const char* name;
  std::size_t size;
  Presence presence;
};
std::optional<std::vector<double>> copy_numbers(const tinyxml2::XMLElement& from,
                                                const NumbersAttribute& attribute,
                                                const XmlPlace& place, tinyxml2::XMLElement& to);

// Copies the attribute if it is present. Returns false if it has a fault.
bool copy_if_there(const tinyxml2::XMLElement& from, const char* attribute, std::size_t size,
                   const XmlPlace& place, tinyxml2::XMLElement& to);

// Copies the <origin> of `parent` if it is present. Returns false if it has a fault.
bool copy_origin(const tinyxml2::XMLElement& parent, const XmlPlace& place,
                 tinyxml2::XMLElement& to);

// Warns of a length beyond any robot's size.
void warn_if_far(double length_m, const std::string& what, const XmlPlace& place);

[[nodiscard]] double norm_of(const std::vector<double>& v);  // of 3 numbers

}  // namespace armloom
