#include "core/model/xml/robot_file.h"

#include <cstdio>

#include "core/model/xml/text_file.h"
#include "core/model/xml/xacro.h"

namespace armloom {
namespace {

// Returns the number of bytes of the UTF-8 character (RFC 3629) at index `at`, or 0 if it is
// invalid.
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first < 0xE0   ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80) return 0;
  }
  const unsigned second = byte(at + 1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool beyond = (first == 0xED && second >= 0xA0) || (first == 0xF4 && second >= 0x90);
  return overlong || beyond ? 0 : length;
}

// Returns a problem if the text is not UTF-8, because it is also sent as JSON.
std::optional<Problem> utf8_fault(const std::string& text, const std::string& path) {
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0) {
      char byte[8];
      std::snprintf(byte, sizeof byte, "0x%02x", static_cast<unsigned char>(text[at]));
      const std::string place = path + ":" + std::to_string(line);
      return Problem{ProblemKind::malformed, "not-utf-8", place,
                     place + ": the byte " + byte +
                         " is not UTF-8; save the file as UTF-8 (iconv -f latin1 -t utf-8)",
                     std::string(byte)};
    }
    if (text[at] == '\n') ++line;
    at += length;
  }
  return std::nullopt;
}

}  // namespace

std::string told_file_name(const std::filesystem::path& path) {
  return path.filename().string() + (path.extension() == ".xacro" ? " (expanded)" : "");
}

std::optional<std::string> load_robot_file(const std::filesystem::path& path,
                                           const std::string& pointer, const std::string& whose,
                                           Diagnostics& diagnostics) {
  auto text = read_text_file(path, pointer, whose);
  if (text && path.extension() == ".xacro") {
    auto expanded = expand_xacro(path);
    if (expanded && !expanded->said.empty())
      diagnostics.warn(Problem{ProblemKind::invalid, "xacro-warns", pointer,
                               whose + ": " + path.string() + ": xacro says: " + expanded->said,
                               path.string()});
    if (expanded)
      text = std::move(expanded->text);
    else
      text = failure(Problem{ProblemKind::invalid, "xacro-failed", pointer,
                             whose + ": cannot expand " + path.string() + ": " + expanded.error(),
                             path.string()});
  }
  if (text) {
    auto fault = utf8_fault(*text, path.string());
    if (!fault) return *std::move(text);
    diagnostics.add(*std::move(fault));
    return std::nullopt;
  }
  for (Problem& problem : text.error()) diagnostics.add(std::move(problem));
  return std::nullopt;
}

}  // namespace armloom
