#pragma once

#include <cstdint>
#include <string>

namespace armloom {

// Returns the `stream` of a simulated session: UUID version 8, from the seed.
[[nodiscard]] std::string stream_of_seed(std::uint64_t seed);
// Returns the `stream` of a server session: random UUID, version 4.
[[nodiscard]] std::string random_stream();

}  // namespace armloom
