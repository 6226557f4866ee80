#include "server/codec/value_formats.h"

#include <algorithm>
#include <limits>

#include "server/codec/scalar_formats.h"

namespace armloom::formats {
namespace {

class FlagFormat final : public CustomFormat<bool> {
 public:
  void read(const JsonNode& node, bool& out) const override { node.read(out); }
  void write(JsonWriter& out, const bool& value) const override { out.value(value); }
  Schema schema(Way) const override { return {{"type", "boolean"}}; }
};

class IntegerFormat final : public CustomFormat<int> {
 public:
  IntegerFormat(int lowest, int highest) : lowest_(lowest), highest_(highest) {}
  void read(const JsonNode& node, int& out) const override {
    std::int64_t number = 0;
    if (node.read_integer(number, lowest_, highest_)) out = static_cast<int>(number);
  }
  void write(JsonWriter& out, const int& number) const override { out.value(number); }
  Schema schema(Way) const override {
    return {{"type", "integer"}, {"minimum", lowest_}, {"maximum", highest_}};
  }

 private:
  int lowest_;
  int highest_;
};

// JSON represents every integer up to this number exactly (RFC 8259, 6).
constexpr std::int64_t kLargestCount = std::int64_t{1} << 53;

class CountFormat final : public CustomFormat<std::uint64_t> {
 public:
  void read(const JsonNode& node, std::uint64_t& out) const override {
    std::int64_t number = 0;
    if (node.read_integer(number, 0, kLargestCount)) {
      out = static_cast<std::uint64_t>(number);
    }
  }
  void write(JsonWriter& out, const std::uint64_t& number) const override { out.value(number); }
  Schema schema(Way way) const override {
    Schema schema{{"type", "integer"}, {"minimum", 0}};
    if (way == Way::in) schema["maximum"] = kLargestCount;
    return schema;
  }
};

class NumberListFormat final : public CustomFormat<std::vector<double>> {
 public:
  void read(const JsonNode& node, std::vector<double>& out) const override { node.read(out); }
  void write(JsonWriter& out, const std::vector<double>& numbers) const override {
    out.value(numbers);
  }
  Schema schema(Way) const override { return {{"type", "array"}, {"items", {{"type", "number"}}}}; }
};

class CellTimeFormat final : public CustomFormat<TimePoint> {
 public:
  explicit CellTimeFormat(FormatPtr<Duration> seconds) : seconds_(std::move(seconds)) {}
  void read(const JsonNode& node, TimePoint& out) const override {
    Duration since{};
    seconds_->read(node, since);
    out = at(since);
  }
  void write(JsonWriter& out, const TimePoint& time) const override { out.value(time); }
  Schema schema(Way way) const override { return seconds_->schema(way); }

 private:
  FormatPtr<Duration> seconds_;
};

class TextOrNullFormat final : public CustomFormat<std::string> {
 public:
  void read(const JsonNode& node, std::string& out) const override {
    if (node.raw().is_null()) return out.clear();
    node.read(out);
  }
  void write(JsonWriter& out, const std::string& text) const override {
    if (text.empty()) return void(out.value(nullptr));
    out.value(text);
  }
  Schema schema(Way) const override { return {{"type", {"string", "null"}}}; }
};

class RuledText final : public CustomFormat<std::string> {
 public:
  explicit RuledText(TextRule rule) : rule_(std::move(rule)) {}
  void read(const JsonNode& node, std::string& out) const override {
    if (node.read(out) && !rule_.holds(out)) node.invalid(rule_.slug, rule_.sentence);
  }
  void write(JsonWriter& out, const std::string& text) const override { out.value(text); }
  Schema schema(Way) const override {
    Schema schema{{"type", "string"}};
    schema.update(rule_.said);
    return schema;
  }

 private:
  TextRule rule_;
};

class AnythingFormat final : public CustomFormat<Anything> {
 public:
  explicit AnythingFormat(std::string type) : type_(std::move(type)) {}
  void read(const JsonNode& node, Anything&) const override {
    if (type_ == "object") (void)node.is_object();
    if (type_ == "array") (void)node.array();
  }
  void write(JsonWriter& out, const Anything&) const override { out.value(nullptr); }
  Schema schema(Way) const override {
    Schema schema = Schema::object();
    if (!type_.empty()) schema["type"] = type_;
    if (type_ == "array") schema["items"] = Schema::object();
    return schema;
  }

 private:
  std::string type_;
};

class NullableFormat final : public AnyFormat {
 public:
  NullableFormat(const AnyFormatPtr& format, const OptionalOperations& operations)
      : format_(format), operations_(operations) {}
  void read_any(const JsonNode& node, void* out) const override {
    if (node.raw().is_null()) return operations_.reset(out);
    format_->read_any(node, operations_.emplace(out));
  }
  void write_any(JsonWriter& out, const void* maybe) const override {
    if (const void* value = operations_.value(maybe)) return format_->write_any(out, value);
    out.value(nullptr);
  }
  Schema schema(Way way) const override { return or_null(format_->schema(way)); }

 private:
  static Schema or_null(Schema schema) {
    if (schema.contains("type") && schema["type"].is_string() && !schema.contains("properties") &&
        !schema.contains("enum")) {
      schema["type"] = Schema{schema["type"], "null"};
      return schema;
    }
    return {{"oneOf", Schema::array({std::move(schema), {{"type", "null"}}})}};
  }

  AnyFormatPtr format_;
  const OptionalOperations& operations_;
};

class ChoiceFormat final : public AnyFormat {
 public:
  explicit ChoiceFormat(const ChoiceOperations& operations) : operations_(operations) {
    for (std::size_t i = 0; operations.name(i) != nullptr; ++i) {
      names_.emplace_back(operations.name(i));
    }
  }
  void read_any(const JsonNode& node, void* out) const override {
    std::string name;
    if (!node.read(name)) return;
    const auto known = std::ranges::find(names_, name);
    if (known == names_.end()) return refuse_choice(node, name, names_);
    operations_.set(out, static_cast<std::size_t>(known - names_.begin()));
  }
  void write_any(JsonWriter& out, const void* choice) const override {
    out.value(names_[operations_.value(choice)]);
  }
  Schema schema(Way) const override { return {{"type", "string"}, {"enum", names_}}; }

 private:
  std::vector<std::string> names_;
  const ChoiceOperations& operations_;
};

class NamedFormat final : public AnyFormat {
 public:
  NamedFormat(std::string_view name, std::string_view text, const AnyFormatPtr& format)
      : name_(name), text_(text), format_(format) {}
  void read_any(const JsonNode& node, void* out) const override { format_->read_any(node, out); }
  void write_any(JsonWriter& out, const void* value) const override {
    format_->write_any(out, value);
  }
  Schema schema(Way way) const override { return named_schema(name_, text_, format_->schema(way)); }

 private:
  std::string name_;
  std::string text_;
  AnyFormatPtr format_;
};

}  // namespace

FormatPtr<bool> flag() { return make_format<FlagFormat>(); }
FormatPtr<int> integer(int lowest, int highest) {
  return make_format<IntegerFormat>(lowest, highest);
}
FormatPtr<int> integer(const NumberRange& range) {
  return integer(static_cast<int>(range.lowest), static_cast<int>(range.highest));
}
FormatPtr<std::uint64_t> count() { return make_format<CountFormat>(); }
FormatPtr<std::vector<double>> number_list() { return make_format<NumberListFormat>(); }
FormatPtr<TimePoint> cell_time() { return make_format<CellTimeFormat>(seconds(kAnyNumber)); }
FormatPtr<TimePoint> cell_time(double highest_s) {
  return make_format<CellTimeFormat>(seconds({0.0, highest_s}));
}
FormatPtr<std::string> text_or_null() { return make_format<TextOrNullFormat>(); }
FormatPtr<std::string> text(TextRule rule) { return make_format<RuledText>(std::move(rule)); }
FormatPtr<Anything> anything(std::string type) {
  return make_format<AnythingFormat>(std::move(type));
}

AnyFormatPtr nullable(const AnyFormatPtr& format, const OptionalOperations& operations) {
  return AnyFormatPtr(new NullableFormat(format, operations));
}

AnyFormatPtr choice(const ChoiceOperations& operations) {
  return AnyFormatPtr(new ChoiceFormat(operations));
}

AnyFormatPtr named(std::string_view name, std::string_view text, const AnyFormatPtr& format) {
  return AnyFormatPtr(new NamedFormat(name, text, format));
}

void refuse_choice(const JsonNode& node, const std::string& found,
                   const std::vector<std::string>& known) {
  std::string names;
  for (std::size_t i = 0; i < known.size(); ++i) {
    names += (i == 0 ? "\"" : i + 1 == known.size() ? " or \"" : ", \"") + known[i] + "\"";
  }
  node.invalid("unknown-choice", "found \"" + found + "\", expected " + names);
}

Schema named_schema(std::string_view name, std::string_view text, Schema schema) {
  if (!text.empty()) schema["description"] = text;
  return {{"$name", name}, {"$of", std::move(schema)}};
}

}  // namespace armloom::formats
