#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace armloom {

// Vertices and faces of an OBJ file in a form that assimp reads safely: one per line, numbers with
// a leading digit, corners by absolute vertex index only.
struct ObjText {
  std::string text;
  std::size_t triangles;  // a face of n corners has n - 2
};

// Reads an OBJ file. Never drops part of its surface silently, as assimp does. The error is a
// phrase that names the line. Errors are an unknown keyword, a vertex that is not three numbers (a
// weight or color may follow), a face with fewer than three corners or an invalid corner, and a
// free-form surface. OBJ has no end marker: a file cut off between two lines is detected only if
// its surface is not closed.
[[nodiscard]] tl::expected<ObjText, std::string> read_obj(std::string_view bytes);

}  // namespace armloom
