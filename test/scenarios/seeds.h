#pragma once

#include <cstdint>
#include <cstdlib>

namespace armloom {

// How many random workloads a test runs: `usual`, or what the environment variable ARMLOOM_SEEDS
// says (long runs by hand). Seeds count from 1, so that a longer run contains the shorter one.
inline std::uint64_t seed_count(std::uint64_t usual) {
  const char* asked = std::getenv("ARMLOOM_SEEDS");
  return asked == nullptr ? usual : std::strtoull(asked, nullptr, 10);
}

}  // namespace armloom
