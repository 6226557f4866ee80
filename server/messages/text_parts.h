#pragma once

// Parts of the texts of server/messages/plain_text.h.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "server/codec/format.h"

namespace armloom {

// Reads of members that may be absent or null.
[[nodiscard]] inline std::string text_at(const Schema& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
}
[[nodiscard]] inline std::optional<double> number_at(const Schema& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_number() ? std::optional(it->get<double>()) : std::nullopt;
}
[[nodiscard]] inline bool flag_at(const Schema& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_boolean() && it->get<bool>();
}
[[nodiscard]] inline const Schema& list_at(const Schema& object, const char* key) {
  static const Schema kEmpty = Schema::array();
  const auto it = object.find(key);
  return it != object.end() && it->is_array() ? *it : kEmpty;
}

[[nodiscard]] inline std::string printed(const char* format, double number) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  return text;
}
[[nodiscard]] inline std::string in_seconds(double s) {
  return printed(s < 9.95 ? "%.1f s" : "%.0f s", std::max(0.0, s));
}
[[nodiscard]] inline std::string percent(const Schema& of) {
  return printed("%.0f %%", std::floor(100.0 * number_at(of, "progress").value_or(0.0)));
}

[[nodiscard]] inline std::string joined(const Schema& names, const char* between) {
  std::string all;
  for (const Schema& name : names) {
    all +=
        (all.empty() ? "" : between) + (name.is_string() ? name.get<std::string>() : name.dump());
  }
  return all;
}
// Returns "waits for job reach of arm left to pass", "40 %" or "completed".
[[nodiscard]] std::string job_note(const Schema& job);

}  // namespace armloom
