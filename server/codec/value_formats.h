#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enumeration.h"
#include "core/base/number_range.h"
#include "core/base/time.h"
#include "server/codec/format.h"

namespace armloom::formats {

// More small formats, of what travels over HTTP.

[[nodiscard]] FormatPtr<bool> flag();
[[nodiscard]] FormatPtr<int> integer(int lowest, int highest);
[[nodiscard]] FormatPtr<int> integer(const NumberRange& range);  // of whole ends
[[nodiscard]] FormatPtr<std::uint64_t> count();                  // from zero on
// As number(kAnyNumber) in a list, quicker: trajectories hold ten thousands.
[[nodiscard]] FormatPtr<std::vector<double>> number_list();
// Cell time in seconds.
[[nodiscard]] FormatPtr<TimePoint> cell_time();
[[nodiscard]] FormatPtr<TimePoint> cell_time(double highest_s);
// An empty text is null.
[[nodiscard]] FormatPtr<std::string> text_or_null();

// A text with a rule. What breaks it is told by `slug` and `sentence`; `said` is what a schema can
// say of the rule.
struct TextRule {
  bool (*holds)(std::string_view);
  std::string slug;
  std::string sentence;
  Schema said;
};
[[nodiscard]] FormatPtr<std::string> text(TextRule rule);

// What is read over or stands for itself: any value of a JSON type; empty: of any.
struct Anything {};
[[nodiscard]] FormatPtr<Anything> anything(std::string type);

// A value that may be null.
[[nodiscard]] Schema or_null(Schema schema);
template <class T>
class NullableFormat final : public Format<std::optional<T>> {
 public:
  explicit NullableFormat(FormatPtr<T> format) : format_(std::move(format)) {}
  void read(const JsonNode& node, std::optional<T>& out) const override {
    if (node.raw().is_null()) return out.reset();
    format_->read(node, out.emplace());
  }
  void write(JsonWriter& out, const std::optional<T>& value) const override {
    if (value) return format_->write(out, *value);
    out.value(nullptr);
  }
  Schema schema(Way way) const override { return or_null(format_->schema(way)); }

 private:
  FormatPtr<T> format_;
};
template <class T>
[[nodiscard]] FormatPtr<std::optional<T>> nullable(FormatPtr<T> format) {
  return make_as_base<NullableFormat<T>>(std::move(format));
}

[[nodiscard]] Schema choice_schema(const std::vector<std::string>& known);
// Says that `found` is none of the names that are known.
void refuse_choice(const JsonNode& node, const std::string& found,
                   const std::vector<std::string>& known);

// An enumeration that is spelt out (core/base/enumeration.h).
template <class E>
class ChoiceFormat final : public Format<E> {
 public:
  void read(const JsonNode& node, E& out) const override {
    std::string name;
    if (!node.read(name)) return;
    if (const auto value = value_named<E>(name)) {
      out = *value;
    } else {
      refuse_choice(node, name, names());
    }
  }
  void write(JsonWriter& out, const E& value) const override { out.value(to_string(value)); }
  Schema schema(Way) const override { return choice_schema(names()); }

 private:
  static std::vector<std::string> names() {
    std::vector<std::string> names;
    for (const E value : kValues<E>) names.emplace_back(to_string(value));
    return names;
  }
};
template <class E>
[[nodiscard]] FormatPtr<E> choice() {
  return make_as_base<ChoiceFormat<E>>();
}

// What other descriptions refer to by name: "Job". In the schema it stands as {"$name", "$of"}
// until references are made of that (schema_names.h).
[[nodiscard]] Schema named_schema(const std::string& name, const std::string& text, Schema schema);
template <class T>
class NamedFormat final : public Format<T> {
 public:
  NamedFormat(std::string name, std::string text, FormatPtr<T> format)
      : name_(std::move(name)), text_(std::move(text)), format_(std::move(format)) {}
  void read(const JsonNode& node, T& out) const override { format_->read(node, out); }
  void write(JsonWriter& out, const T& value) const override { format_->write(out, value); }
  Schema schema(Way way) const override { return named_schema(name_, text_, format_->schema(way)); }

 private:
  std::string name_;
  std::string text_;  // may be empty
  FormatPtr<T> format_;
};
template <class T>
[[nodiscard]] FormatPtr<T> named(std::string name, std::string text, FormatPtr<T> format) {
  return make_as_base<NamedFormat<T>>(std::move(name), std::move(text), std::move(format));
}

}  // namespace armloom::formats
