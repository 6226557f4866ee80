#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

// libFuzzer calls this with each input; it returns 0. A target demands of the code what its
// contract promises, whatever the input, and stops the process when it does not hold.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace armloom::fuzz {

// Not assert(): it has to hold in every build type.
inline void demand(bool holds) {
  if (!holds) std::abort();
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return size == 0 ? std::string() : std::string(reinterpret_cast<const char*>(data), size);
}

}  // namespace armloom::fuzz
