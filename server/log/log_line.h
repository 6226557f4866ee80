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

// A line of the server's log: a sentence for people, and fields for programs.
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

// Returns the line as text: "the sentence key=value key="a value"". Escapes control characters and
// invalid UTF-8, so that client input stays on the line and does not control a terminal.
[[nodiscard]] std::string text_of(const LogLine& line);
// Returns one JSON object: at (RFC 3339, UTC), level, message, then the fields.
[[nodiscard]] std::string json_of(const LogLine& line, std::chrono::system_clock::time_point at);

// Requests that are logged.
enum class LoggedRequests { none, commands, all };

}  // namespace armloom
