#include "server/codec/scalar_formats.h"

#include <algorithm>
#include <cmath>

#include "server/codec/value_formats.h"

namespace armloom::formats {
namespace {

std::string spelled(double number) { return as_json(number).dump(); }

std::string sentence(const Range& range) {
  const bool below = std::isfinite(range.lowest);
  if (below && !range.open && !range.open_above && std::isfinite(range.highest)) {
    return "is not within " + spelled(range.lowest) + ".." + spelled(range.highest);
  }
  std::string text;
  if (below && range.open && range.lowest == 0.0) {
    text = "is not greater than zero";
  } else if (below) {
    text = (range.open ? "is not greater than " : "is less than ") + spelled(range.lowest);
  }
  if (!std::isfinite(range.highest)) return text;
  return (text.empty() ? "is not" : text + " and") +
         (range.open_above ? " less than " : " at most ") + spelled(range.highest);
}

Schema schema_of(const Range& range) {
  Schema schema{{"type", "number"}};
  if (std::isfinite(range.lowest)) {
    schema[range.open ? "exclusiveMinimum" : "minimum"] = as_json(range.lowest);
  }
  if (std::isfinite(range.highest))
    schema[range.open_above ? "exclusiveMaximum" : "maximum"] = as_json(range.highest);
  return schema;
}

bool read_within(const JsonNode& node, const Range& range, double& out) {
  double number = 0.0;
  if (!node.read(number)) return false;
  if (!range.holds(number)) {
    node.invalid("out-of-range", spelled(number) + " " + sentence(range));
    return false;
  }
  out = number;
  return true;
}

class NumberFormat final : public CustomFormat<double> {
 public:
  explicit NumberFormat(Range range) : range_(range) {}
  void read(const JsonNode& node, double& out) const override { read_within(node, range_, out); }
  void write(JsonWriter& out, const double& number) const override { out.value(number); }
  Schema schema(Way) const override { return schema_of(range_); }

 private:
  Range range_;
};

class SecondsFormat final : public CustomFormat<Duration> {
 public:
  explicit SecondsFormat(Range range) : range_(range) {}
  void read(const JsonNode& node, Duration& out) const override {
    double seconds = 0.0;
    if (read_within(node, range_, seconds)) out = from_seconds(seconds);
  }
  void write(JsonWriter& out, const Duration& time) const override { out.value(time); }
  Schema schema(Way) const override { return schema_of(range_); }

 private:
  Range range_;
};

class TextFormat : public CustomFormat<std::string> {
 public:
  void read(const JsonNode& node, std::string& out) const override { node.read(out); }
  void write(JsonWriter& out, const std::string& text) const override { out.value(text); }
  Schema schema(Way) const override { return {{"type", "string"}}; }
};

class NameFormat : public TextFormat {
 public:
  explicit NameFormat(std::string what) : what_(std::move(what)) {}
  void read(const JsonNode& node, std::string& out) const override {
    if (node.read(out) && out.empty())
      node.invalid("empty-" + what_, "a " + what_ + " is required, found an empty string");
  }
  Schema schema(Way) const override { return {{"type", "string"}, {"minLength", 1}}; }

 private:
  std::string what_;
};

class PathFormat final : public NameFormat {
 public:
  PathFormat() : NameFormat("path") {}
  void map_paths(nlohmann::json& value, const PathMap& map) const override {
    if (!value.is_string()) return;
    auto& path = value.get_ref<std::string&>();
    if (!path.empty() && path.find("://") == path.npos) path = map(path);
  }
};

class OneOfFormat final : public TextFormat {
 public:
  explicit OneOfFormat(std::vector<std::string> names) : names_(std::move(names)) {}
  void read(const JsonNode& node, std::string& out) const override {
    if (!node.read(out) || std::ranges::find(names_, out) != names_.end()) return;
    refuse_choice(node, out, names_);
  }
  Schema schema(Way) const override { return {{"type", "string"}, {"enum", names_}}; }

 private:
  std::vector<std::string> names_;
};

// Describes an array of fixed size. `Numbers` may be any container.
template <class Numbers, std::size_t size>
class NumbersFormat final : public CustomFormat<Numbers> {
 public:
  explicit NumbersFormat(Range range) : range_(range) {}
  void read(const JsonNode& node, Numbers& out) const override {
    std::array<double, size> numbers{};
    if (!node.read_numbers(numbers.data(), size)) return;
    if (std::ranges::all_of(numbers, [&](double number) { return range_.holds(number); })) {
      std::ranges::copy(numbers, out.data());
      return;
    }
    const auto outside =
        std::ranges::find_if(numbers, [&](double number) { return !range_.holds(number); });
    node.invalid("out-of-range", spelled(*outside) + " " + sentence(range_) + ", found " +
                                     node.raw().dump() + range_.remedy);
  }
  void write(JsonWriter& out, const Numbers& numbers) const override {
    out.begin_array();
    for (const double number : numbers) out.value(number);
    out.end_array();
  }
  Schema schema(Way) const override {
    return {
        {"type", "array"}, {"items", schema_of(range_)}, {"minItems", size}, {"maxItems", size}};
  }

 private:
  Range range_;
};

}  // namespace

FormatPtr<double> number(Range range) { return make_format<NumberFormat>(range); }
FormatPtr<Duration> seconds(Range range) { return make_format<SecondsFormat>(range); }
FormatPtr<std::string> text() { return make_format<TextFormat>(); }
FormatPtr<std::string> name() { return make_format<NameFormat>("name"); }
FormatPtr<std::string> path() { return make_format<PathFormat>(); }
FormatPtr<std::string> one_of(std::vector<std::string> names) {
  return make_format<OneOfFormat>(std::move(names));
}
FormatPtr<Eigen::Vector3d> vector3(Range range) {
  return make_format<NumbersFormat<Eigen::Vector3d, 3>>(range);
}
template <std::size_t size>
FormatPtr<std::array<double, size>> numbers(Range range) {
  return make_format<NumbersFormat<std::array<double, size>, size>>(range);
}
template FormatPtr<std::array<double, 1>> numbers<1>(Range);
template FormatPtr<std::array<double, 2>> numbers<2>(Range);
template FormatPtr<std::array<double, 12>> numbers<12>(Range);

}  // namespace armloom::formats
