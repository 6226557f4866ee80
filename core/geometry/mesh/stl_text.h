#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace armloom {

// Returns an STL file in binary form. A binary file is returned unchanged; a text file is
// converted, with the triangles of all its solids. The error is a phrase that names the line ("line
// 12: expected 'facet' or 'endsolid', found 'facte'"). Detects truncated files: a text must end
// with `endsolid`, a binary file must have the length given by its triangle count. Ignores case and
// normals.
[[nodiscard]] tl::expected<std::string, std::string> read_stl(std::string bytes);

// Returns the triangle count of read_stl()'s result.
[[nodiscard]] std::size_t triangles_of_stl(std::string_view binary);

}  // namespace armloom
