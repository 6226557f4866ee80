#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/codec/format.h"

namespace armloom::formats {

// Describes an integer with any value of T, for files and protocols of programs. Clients' numbers
// are described by count() and integer(), which have bounds.
template <class T>
class WholeFormat final : public CustomFormat<T> {
 public:
  void read(const JsonNode& node, T& out) const override {
    const nlohmann::json& raw = node.raw();
    const bool fits = raw.is_number_integer() && std::in_range<T>(raw.get<std::int64_t>());
    if (raw.is_number_unsigned() ? std::in_range<T>(raw.get<std::uint64_t>()) : fits) {
      return void(out = raw.get<T>());
    }
    node.fault(ProblemKind::malformed, "wrong-type", "a whole number is expected here");
  }
  void write(JsonWriter& out, const T& number) const override { out.value(number); }
  Schema schema(Way) const override { return {{"type", "integer"}}; }
};
template <class T = std::uint64_t>
[[nodiscard]] FormatPtr<T> whole() {
  return make_format<WholeFormat<T>>();
}

}  // namespace armloom::formats
