#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "server/codec/format.h"
#include "server/codec/json_text.h"

namespace armloom {

// Reads a JSON text. Returns all faults, with pointers into the text.
template <class T>
[[nodiscard]] Result<T> read_text(const Format<T>& format, std::string_view text) {
  const auto body = parse_json(text, JsonComments::refused);
  if (!body) return failure(body.error());
  Problems faults;
  T value{};
  format.read(JsonNode(*body, "", faults), value);
  if (!faults.empty()) return failure(std::move(faults));
  return value;
}

// Returns the value as JSON. `clock` is null if wall time is unknown.
template <class T>
[[nodiscard]] std::string text_of(const Format<T>& format, const T& value,
                                  const WallClock* clock = nullptr) {
  JsonWriter out(clock);
  format.write(out, value);
  return out.take();
}

}  // namespace armloom
