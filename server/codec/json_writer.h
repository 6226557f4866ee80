#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/time.h"

namespace armloom {

class WallClock;

// Writes JSON without spaces. Numbers are written so that they read back the same. The text is
// always valid: NaN and infinities become null, -0 becomes 0, invalid UTF-8 becomes U+FFFD. The
// caller must balance begin and end.
class JsonWriter {
 public:
  JsonWriter() = default;
  // `clock` converts cell time to wall time and must outlive the writer. It is null if wall time is
  // unknown.
  explicit JsonWriter(const WallClock* clock) : clock_(clock) {}

  JsonWriter& begin_object() { return open('{'); }
  JsonWriter& end_object() { return close('}'); }
  JsonWriter& begin_array() { return open('['); }
  JsonWriter& end_array() { return close(']'); }
  JsonWriter& key(std::string_view name);

  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
  JsonWriter& value(double number);
  JsonWriter& value(std::nullptr_t) { return raw("null"); }
  // Writes seconds. Divides by 1e9 instead of multiplying by 1e-9, so that whole milliseconds are
  // written exactly.
  JsonWriter& value(Duration time) { return value(static_cast<double>(time.count()) / 1e9); }
  JsonWriter& value(TimePoint time) { return value(time.time_since_epoch()); }
  template <class T>
  requires std::is_integral_v<T> JsonWriter& value(T number) {
    if constexpr (std::is_same_v<T, bool>) {
      return raw(number ? "true" : "false");
    } else {
      char digits[24];
      const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
      return raw({digits, static_cast<std::size_t>(end - digits)});
    }
  }
  template <class T>
  JsonWriter& value(const std::optional<T>& maybe) {
    return maybe ? value(*maybe) : value(nullptr);
  }
  template <class T>
  JsonWriter& value(const std::vector<T>& list) {
    begin_array();
    for (const T& item : list) value(item);
    return end_array();
  }
  // Rounds to `decimals` (0..9) places.
  JsonWriter& rounded(double number, int decimals);
  // Returns false in a simulated session, where keys ending in _at are not written.
  [[nodiscard]] bool knows_wall_time() const { return clock_ != nullptr; }
  JsonWriter& wall_time(std::optional<TimePoint> time);  // nullopt is written as null
  // Writes `json`, which must be valid.
  JsonWriter& raw(std::string_view json);

  template <class T>
  JsonWriter& field(std::string_view name, const T& content) {
    key(name);
    return value(content);
  }

  [[nodiscard]] const std::string& text() const { return out_; }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  JsonWriter& open(char bracket);
  JsonWriter& close(char bracket);
  void separate();

  const WallClock* clock_ = nullptr;
  std::string out_;
  bool comma_ = false;  // the next value on this level needs a comma
};

}  // namespace armloom
