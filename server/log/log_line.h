#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace armloom {

// One line of the server's log: a sentence for people, and what programs look for.
struct LogLine {
  enum class Level { info, warning, error };
  Level level = Level::info;
  std::string message;
  std::vector<std::pair<std::string, std::variant<std::string, std::int64_t, double>>> fields = {};
};
[[nodiscard]] constexpr const char* to_string(LogLine::Level level) {
  switch (level) {
    case LogLine::Level::info:
      return "info";
    case LogLine::Level::warning:
      return "warning";
    case LogLine::Level::error:
      return "error";
  }
  return nullptr;
}

using Log = std::function<void(const LogLine&)>;

// "the sentence key=value key="a value"": whatever clients put into it stays on this line, and a
// terminal shows it as text: control characters and what is no UTF-8 stand as escapes.
[[nodiscard]] std::string text_of(const LogLine& line);
// The same as one JSON object: at (RFC 3339, UTC), level, message, then the fields.
[[nodiscard]] std::string json_of(const LogLine& line, std::chrono::system_clock::time_point at);

// Which requests are told in the log.
enum class LoggedRequests { none, commands, all };

}  // namespace armloom
