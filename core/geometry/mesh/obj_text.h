#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace armloom {

// The vertices and faces of an OBJ file, as assimp reads them safely: one to a line, numbers with a
// digit in front, corners by the vertex' index alone and counted from the first.
struct ObjText {
  std::string text;
  std::size_t triangles;  // a face of n corners is n - 2
};

// Whatever the file says of its surface is in it, or there is an error (assimp drops what it does
// not understand): half a sentence that names the line. Errors are a word that OBJ does not know, a
// vertex that is not three numbers (a weight or a colour may follow), a face of fewer than three
// corners or with a corner that is no vertex, a free-form surface. An OBJ has no end of its own:
// one that was cut off between two lines is only known by what it no longer encloses.
[[nodiscard]] tl::expected<ObjText, std::string> read_obj(std::string_view bytes);

}  // namespace armloom
