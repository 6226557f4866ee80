#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

// Called by libFuzzer with each input; returns 0. Aborts if the code breaks a promise of its
// contract.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace armloom::fuzz {

// Unlike assert(), active in every build type.
inline void demand(bool holds) {
  if (!holds) std::abort();
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return size == 0 ? std::string() : std::string(reinterpret_cast<const char*>(data), size);
}

}  // namespace armloom::fuzz
