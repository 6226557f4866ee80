#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace armloom {

// Returns the number of random workloads of a test: `usual` or the environment variable
// ARMLOOM_SEEDS, divided by `part`, at least 1. Seeds start at 1, so that a longer run contains the
// shorter one. Throws std::invalid_argument if ARMLOOM_SEEDS is not a whole number above 0.
inline std::uint64_t seed_count(std::uint64_t usual, std::uint64_t part = 1) {
  std::uint64_t count = usual;
  if (const char* variable = std::getenv("ARMLOOM_SEEDS")) {
    const std::string_view asked(variable);
    const auto [end, error] = std::from_chars(asked.begin(), asked.end(), count);
    if (error != std::errc{} || end != asked.end() || count == 0) {
      throw std::invalid_argument("ARMLOOM_SEEDS=" + std::string(asked) +
                                  ": how many seeds to run, a whole number above 0");
    }
  }
  return std::max<std::uint64_t>(1, count / part);
}

}  // namespace armloom
