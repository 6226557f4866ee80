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

// Writes JSON text front to back, keys in the order in which they are given, without spaces.
// Numbers are written in the shortest form that reads back the same; numbers that JSON does not
// have (NaN, infinities) become null, -0 becomes 0, bytes that are not UTF-8 become U+FFFD: the
// text is always valid JSON. Nesting is the caller's duty: each begin has its end, each key its
// value.
class JsonWriter {
 public:
  JsonWriter() = default;
  // Knows the wall time of cell times. `clock` outlives the writer; null: it knows none.
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
  // Seconds; divided, not multiplied, so that a whole millisecond is written as one.
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
  // Rounded to `decimals` (0..9) places: short, for poses that are only looked at.
  JsonWriter& rounded(double number, int decimals);
  // Keys that end in _at are only written where wall time is known: not in a simulated run.
  [[nodiscard]] bool knows_wall_time() const { return clock_ != nullptr; }
  JsonWriter& wall_time(std::optional<TimePoint> time);  // absent: null
  // Text that is JSON already.
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
  bool comma_ = false;  // something stands before, on this level
};

}  // namespace armloom
