#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace armloom {

// The vertices and faces of an OBJ file, rewritten so that assimp reads them safely. Each is on a
// line of its own, numbers begin with a digit, and corners are given only by absolute vertex index.
struct ObjText {
  std::string text;
  std::size_t triangles;  // a face of n corners gives n - 2 triangles
};

// Reads an OBJ file. Unlike assimp, never drops a part of the surface silently. The error is a
// phrase that names the line. Errors are:
// - an unknown keyword,
// - a vertex that is not three numbers (a weight or color may follow),
// - a face with fewer than three corners or an invalid corner,
// - a free-form surface.
//
// A file cut off between two lines is detected only if its surface is not closed.
[[nodiscard]] tl::expected<ObjText, std::string> read_obj(std::string_view bytes);

}  // namespace armloom
