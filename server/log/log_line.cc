#include "server/log/log_line.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "server/codec/json_writer.h"
#include "server/codec/rfc3339.h"
#include "server/codec/wall_clock.h"

namespace armloom {
namespace {

using Value = decltype(LogLine::fields)::value_type::second_type;

// Returns `text` as a JSON string, with the quotes.
std::string in_quotes(std::string_view text) {
  JsonWriter out;
  out.value(text);
  return out.take();
}

// Escapes characters in JSON text that may mislead a terminal or its reader: C1 controls, line
// separators and bidirectional marks.
std::string for_terminals(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    if (byte(i) == 0xc2) code = byte(i + 1);
    if (byte(i) == 0xe2) code = 0x2000U | (byte(i + 1) & 0x3fU) << 6U | (byte(i + 2) & 0x3fU);
    const bool is_c1 = 0x80 <= code && code <= 0x9f;
    const bool is_mark = code == 0x200e || code == 0x200f || (0x2028 <= code && code <= 0x202e) ||
                         (0x2066 <= code && code <= 0x2069);
    if (!is_c1 && !is_mark) {
      out += text[i];
      continue;
    }
    std::array<char, 7> escaped{};
    std::snprintf(escaped.data(), escaped.size(), "\\u%04x", code);
    out += escaped.data();
    i += is_c1 ? 1 : 2;
  }
  return out;
}

void write(JsonWriter& out, const Value& value) {
  std::visit([&](const auto& what) { out.value(what); }, value);
}

std::string shown(const Value& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) {
    JsonWriter out;
    write(out, value);
    return out.take();
  }
  const auto is_plain = [](char c) { return c > ' ' && c < 0x7f && c != '"' && c != '='; };
  const bool is_word = !text->empty() && std::ranges::all_of(*text, is_plain);
  return is_word && text->find('\\') == text->npos ? *text : in_quotes(*text);
}

}  // namespace

std::string text_of(const LogLine& line) {
  std::string text = in_quotes(line.message);
  text = text.substr(1, text.size() - 2);
  for (const auto& [key, value] : line.fields) text += " " + key + "=" + shown(value);
  return for_terminals(text);
}

std::string json_of(const LogLine& line, std::chrono::system_clock::time_point at) {
  JsonWriter out;
  out.begin_object().field("at", rfc3339(since_1970_ms(at)));
  out.field("level", to_string(line.level)).field("message", line.message);
  for (const auto& [key, value] : line.fields) {
    out.key(key);
    write(out, value);
  }
  out.end_object();
  return for_terminals(out.take());
}

}  // namespace armloom
