#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace armloom {

// A COLLADA document, checked and reduced to its geometry. Without these checks, assimp 5.2
// - reads past the end of arrays if an accessor is too long,
// - recurses forever through cyclic nodes, and
// - fills the memory if an index is not a number.
struct DaeEssence {
  std::string text;       // asset, geometries, nodes, scenes; no materials, images, controllers
  std::size_t triangles;  // upper bound, with every instance included; saturates at 10^15
};

// The error is a phrase: "<p> holds 'x', which is not a valid index".
[[nodiscard]] tl::expected<DaeEssence, std::string> read_dae_essence(std::string_view bytes);

}  // namespace armloom
