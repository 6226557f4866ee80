#include "server/codec/stream_id.h"

#include <cstdio>
#include <random>

namespace armloom {
namespace {

std::string uuid(std::uint64_t high, std::uint64_t low, unsigned version) {
  high = (high & ~0xF000ULL) | (static_cast<std::uint64_t>(version) << 12U);
  low = (low & 0x3FFF'FFFF'FFFF'FFFFULL) | 0x8000'0000'0000'0000ULL;  // RFC 9562 variant
  char text[40];
  std::snprintf(text, sizeof text, "%08x-%04x-%04x-%04x-%012llx",
                static_cast<unsigned>(high >> 32U), static_cast<unsigned>((high >> 16U) & 0xFFFFU),
                static_cast<unsigned>(high & 0xFFFFU), static_cast<unsigned>(low >> 48U),
                static_cast<unsigned long long>(low & 0xFFFF'FFFF'FFFFULL));
  return text;
}

}  // namespace

std::string stream_of_seed(std::uint64_t seed) {
  // splitmix64 (Steele, Lea, Flood 2014)
  const auto next = [&seed] {
    std::uint64_t z = (seed += 0x9E37'79B9'7F4A'7C15ULL);
    z = (z ^ (z >> 30U)) * 0xBF58'476D'1CE4'E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D0'49BB'1331'11EBULL;
    return z ^ (z >> 31U);
  };
  const std::uint64_t high = next();
  return uuid(high, next(), 8);
}

std::string random_stream() {
  std::random_device device;
  const auto word = [&] { return (static_cast<std::uint64_t>(device()) << 32U) | device(); };
  const std::uint64_t high = word();
  return uuid(high, word(), 4);
}

}  // namespace armloom
