#pragma once

#include <charconv>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/enumeration.h"
#include "core/base/problem.h"
#include "server/api/route.h"
#include "server/http/message.h"

namespace armloom {

// A query parameter: how to read it, and its entry in /openapi.json.
template <class T>
struct QueryPart {
  Parameter parameter;
  // Stores the value in `out`. Returns what is wrong with the value, or nullopt.
  std::function<std::optional<std::string>(const std::string& value, T& out)> take;
};

template <class T>
class QueryFormat {
 public:
  // `bad`: kind of the problem if a parameter cannot be read, `invalid` (422) or `malformed` (400).
  QueryFormat(std::vector<QueryPart<T>> parts, ProblemKind bad)
      : parts_(std::move(parts)), bad_(bad) {}

  // Reads a query. Problems: unreadable or missing parameters. The router refuses unknown
  // parameters.
  [[nodiscard]] Result<T> read(const Target& target) const {
    T query{};
    Problems problems;
    for (const QueryPart<T>& part : parts_) {
      const std::string& name = part.parameter.name;
      const auto value = target.parameter(name);
      if (!value && !part.parameter.required) continue;
      auto fault = value ? part.take(*value, query)
                         : std::optional(name + " is missing: add it to the query");
      if (!fault) continue;
      const bool is_missing = part.parameter.required && value.value_or("").empty();
      problems.push_back({is_missing ? ProblemKind::malformed : bad_,
                          is_missing ? "missing-parameter" : "bad-parameter", "?" + name,
                          *std::move(fault), value.value_or("")});
    }
    if (!problems.empty()) return failure(std::move(problems));
    return query;
  }

  [[nodiscard]] std::vector<Parameter> parameters() const {
    std::vector<Parameter> all;
    for (const QueryPart<T>& part : parts_) all.push_back(part.parameter);
    return all;
  }

 private:
  std::vector<QueryPart<T>> parts_;
  ProblemKind bad_;
};

namespace query {

// Sets `out` and returns true if the text is an integer within the bounds.
template <class Number>
[[nodiscard]] bool read_between(const std::string& text, Number lowest, Number highest,
                                Number& out) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, ec] = std::from_chars(text.data(), end, number);
  if (ec != std::errc{} || stop != end || number < lowest || number > highest) return false;
  out = number;
  return true;
}

[[nodiscard]] inline std::string whole(double bound) {
  return std::to_string(static_cast<std::int64_t>(bound));
}

// Describes a parameter that may have any text. If the member belongs to a base class of T, the
// caller must name T: text<AuditQuery>(...).

template <class T, class Of, class Text>
[[nodiscard]] QueryPart<T> text(std::string name, Text Of::*where, std::string description) {
  return {{std::move(name), std::move(description), {{"type", "string"}}},
          [where](const std::string& value, T& out) {
            out.*where = value;
            return std::optional<std::string>();
          }};
}

// Describes a required parameter, a text that must not be empty.
template <class T>
[[nodiscard]] QueryPart<T> required_text(std::string name, std::string T::*where,
                                         std::string description) {
  return {{name, std::move(description), {{"type", "string"}, {"minLength", 1}}, true},
          [name, where](const std::string& value, T& out) {
            out.*where = value;
            return value.empty() ? std::optional(name + " must not be empty") : std::nullopt;
          }};
}

template <class T, class Of, class Number, class Value>
[[nodiscard]] QueryPart<T> whole_number(std::string name, Number Of::*where, Value lowest,
                                        Value highest, std::string description) {
  const std::string rule = name + " must be an integer within " + std::to_string(lowest) + ".." +
                           std::to_string(highest) + ", found \"";
  return {{std::move(name),
           std::move(description),
           {{"type", "integer"}, {"minimum", lowest}, {"maximum", highest}}},
          [where, lowest, highest, rule](const std::string& value, T& out) {
            Value number{};
            const bool is_read = read_between(value, lowest, highest, number);
            if (is_read) out.*where = number;
            return is_read ? std::nullopt : std::optional(rule + value + "\"");
          }};
}

template <class T, class Number>
[[nodiscard]] QueryPart<T> number(std::string name, Number T::*where, double lowest, double highest,
                                  std::string description) {
  const std::string rule =
      name + " must be a number within " + whole(lowest) + ".." + whole(highest) + ", found \"";
  return {{std::move(name),
           std::move(description),
           {{"type", "number"}, {"minimum", as_json(lowest)}, {"maximum", as_json(highest)}}},
          [where, lowest, highest, rule](const std::string& value, T& out) {
            double number{};
            const bool is_read = read_between(value, lowest, highest, number);
            if (is_read) out.*where = number;
            return is_read ? std::nullopt : std::optional(rule + value + "\"");
          }};
}

template <class T, class E>
[[nodiscard]] QueryPart<T> one_of(std::string name, std::optional<E> T::*where, Schema schema,
                                  std::string description) {
  const std::string rule = "unknown " + name + " \"";
  return {{std::move(name), std::move(description), std::move(schema)},
          [where, rule](const std::string& value, T& out) {
            out.*where = value_named<E>(value);
            return out.*where ? std::nullopt : std::optional(rule + value + "\"");
          }};
}

// Number of entries on a page.
inline constexpr std::size_t kPage = 100;  // default
inline constexpr std::size_t kPageMax = 1000;
template <class T>
[[nodiscard]] QueryPart<T> limit(std::size_t T::*where) {
  return whole_number<T>("limit", where, std::size_t{1}, kPageMax,
                         "Number of entries per page; default " + std::to_string(kPage) + "");
}

// Describes the position where the previous page ended, encoded by the server.
template <class T, class Of>
[[nodiscard]] QueryPart<T> cursor(std::optional<std::uint64_t> Of::*where) {
  return {{"cursor", "`next_cursor` of the previous page", {{"type", "string"}}},
          [where](const std::string& value, T& out) -> std::optional<std::string> {
            std::uint64_t number = 0;
            if (!read_between<std::uint64_t>(value, 0, ~std::uint64_t{0}, number)) {
              return "not a cursor of this server (use next_cursor of the previous page): \"" +
                     value + "\"";
            }
            out.*where = number;
            return std::nullopt;
          }};
}

template <class T>
[[nodiscard]] QueryPart<T> flag(std::string name, bool T::*where, std::string description) {
  const std::string rule = name + " must be 0 or 1, found \"";
  return {{std::move(name), std::move(description), {{"type", "string"}, {"enum", {"0", "1"}}}},
          [where, rule](const std::string& value, T& out) {
            out.*where = value == "1";
            const bool is_read = value == "0" || value == "1";
            return is_read ? std::nullopt : std::optional(rule + value + "\"");
          }};
}

}  // namespace query

}  // namespace armloom
