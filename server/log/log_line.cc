#include "server/log/log_line.h"

#include <algorithm>

#include "server/codec/json_writer.h"
#include "server/codec/rfc3339.h"
#include "server/codec/wall_clock.h"

namespace armloom {
namespace {

using Value = decltype(LogLine::fields)::value_type::second_type;

// As JSON escapes it, with the quotes.
std::string in_quotes(std::string_view text) {
  JsonWriter out;
  out.value(text);
  return out.take();
}

void write(JsonWriter& out, const Value& value) {
  std::visit([&](const auto& what) { out.value(what); }, value);
}

// Words stand as they are.
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
  return text;
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
  return out.take();
}

}  // namespace armloom
