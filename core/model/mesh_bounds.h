#pragma once

#include <cstddef>
#include <string_view>

namespace armloom {

// Whether an STL is text. Binary ones may begin with "solid" too, but then have the size that their
// header says.
[[nodiscard]] bool is_text_stl(std::string_view bytes);

// How many triangles the file cannot have more than, by counting and without building anything, so
// that a file that would fill the memory is known before it is read.
//   STL   binary: what the header says (80 bytes, the number, 50 bytes for each); text: a third of
//         the words "vertex"
//   OBJ   a face of n corners is n - 2 triangles
[[nodiscard]] std::size_t most_triangles_of_stl(std::string_view bytes);
[[nodiscard]] std::size_t most_triangles_of_obj(std::string_view bytes);

}  // namespace armloom
