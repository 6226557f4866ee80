#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string_view>

namespace armloom {

// A 64-bit content hash, equal on every machine. Not cryptographic: detects only accidental
// changes.
class ContentHash {
 public:
  void add(std::unsigned_integral auto value) { mix(static_cast<std::uint64_t>(value)); }
  void add(double value) { mix(std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value)); }
  void add(std::string_view text) {
    mix(text.size());
    for (const char c : text) mix(static_cast<unsigned char>(c));
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  // The finalizer of splitmix64 (Steele, Lea and Flood 2014), chained.
  void mix(std::uint64_t x) {
    x += value_ + 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    value_ = x ^ (x >> 31U);
  }

  std::uint64_t value_ = 0;
};

}  // namespace armloom
