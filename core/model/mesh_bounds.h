#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace armloom {

enum class MeshFormat { stl, obj, dae };

// How many triangles the file cannot have more than, by counting and without building anything, so
// that a file that would fill the memory is known before it is read. A DAE counts each geometry as
// often as its nodes place it, which may grow exponentially: saturates at 10^15. The error is half a
// sentence ("it is no XML: ..."): a DAE that is no XML, or whose nodes place themselves.
[[nodiscard]] tl::expected<std::size_t, std::string> most_triangles(MeshFormat format,
                                                                    std::string_view bytes);

}  // namespace armloom
