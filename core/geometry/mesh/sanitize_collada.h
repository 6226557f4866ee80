#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace armloom {

// A COLLADA document cut down to its geometry, after everything in that has been checked that
// assimp trusts: assimp 5.2 reads past the end of arrays whose accessors promise too much, follows
// nodes that place themselves for ever, and fills the memory when an index is no number.
struct DaeEssence {
  std::string text;       // asset, geometries, nodes and scenes; no materials, images, controllers
  std::size_t triangles;  // at most; each geometry as often as nodes place it, saturates at 10^15
};

// The error is half a sentence: "<p> holds 'x', which is no index".
[[nodiscard]] tl::expected<DaeEssence, std::string> read_dae_essence(std::string_view bytes);

}  // namespace armloom
