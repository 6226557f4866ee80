#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace armloom {

// Vertices and faces of an OBJ file as assimp reads them safely: one per line, numbers with a
// leading digit, corners by absolute vertex index only.
struct ObjText {
  std::string text;
  std::size_t triangles;  // a face of n corners has n - 2
};

// Reads an OBJ file. Unlike assimp, never drops part of its surface silently. The error is a phrase
// that names the line: an unknown keyword, a vertex that is not three numbers (a weight or color
// may follow), a face with fewer than three corners or an invalid corner, or a free-form surface. A
// file cut off between two lines is detected only if its surface is not closed.
[[nodiscard]] tl::expected<ObjText, std::string> read_obj(std::string_view bytes);

}  // namespace armloom
