#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace armloom {

// An STL file as a binary one: the triangles of a file in text, of all its solids, and a binary
// file as it is. Whatever the file holds is in it, or there is an error: half a sentence that names
// the line ("line 12: 'facte' stands where 'facet' or 'endsolid' is due"). A text must come to its
// `endsolid`, and a binary file have the length that its count of triangles makes, so that a file
// that was cut off is known. Upper and lower case are alike; normals are not looked at.
[[nodiscard]] tl::expected<std::string, std::string> read_stl(std::string bytes);

// Of what read_stl gives.
[[nodiscard]] std::size_t triangles_of_stl(std::string_view binary);

}  // namespace armloom
