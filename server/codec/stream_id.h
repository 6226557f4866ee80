#pragma once

#include <cstdint>
#include <string>

namespace armloom {

// The `stream` of a simulated run: a UUID (version 8) that follows from the seed.
[[nodiscard]] std::string stream_of_seed(std::uint64_t seed);
// The `stream` of a run of the server: a random UUID (version 4).
[[nodiscard]] std::string random_stream();

}  // namespace armloom
