#include "server/codec/yaml_text.h"

#include <yaml-cpp/yaml.h>

#include <charconv>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "server/codec/json_pointer.h"
#include "server/codec/json_text.h"

namespace armloom {
namespace {

using nlohmann::json;

std::string place_of(const YAML::Mark& mark) {
  return "line " + std::to_string(mark.line + 1) + ", column " + std::to_string(mark.column + 1);
}

// Returns the number that the whole text spells in decimal; nullopt if it is not a number.
std::optional<json> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  std::int64_t whole = 0;
  if (const auto read = std::from_chars(text.data(), end, whole);
      read.ec == std::errc() && read.ptr == end) {
    return json(whole);
  }
  double number = 0.0;
  const auto read = std::from_chars(text.data(), end, number);
  // "nan" and "inf" without a dot are strings in YAML.
  const bool is_number = read.ec == std::errc() && read.ptr == end && std::isfinite(number);
  return is_number ? std::optional(json(number)) : std::nullopt;
}

class Conversion {
 public:
  json convert(const YAML::Node& node) {
    if (++values_ > kYamlValuesMax || depth_ > kJsonDepthMax) {
      fail(node, ProblemKind::too_large, "too-large",
           "more than " + std::to_string(kYamlValuesMax) + " values, or more than " +
               std::to_string(kJsonDepthMax) + " levels");
    }
    switch (node.Type()) {
      case YAML::NodeType::Map:
        return object_of(node);
      case YAML::NodeType::Sequence:
        return array_of(node);
      case YAML::NodeType::Scalar:
        return scalar_of(node);
      default:
        return nullptr;
    }
  }

 private:
  json object_of(const YAML::Node& node) {
    json object = json::object();
    ++depth_;
    for (const auto& member : node) {
      if (!member.first.IsScalar()) {
        fail(member.first, ProblemKind::malformed, "malformed-yaml", "a key must be a scalar");
      }
      const std::string& key = member.first.Scalar();
      if (object.contains(key)) {
        fail(member.first, ProblemKind::malformed, "malformed-yaml",
             "the key \"" + key + "\" is given twice");
      }
      const std::size_t above = pointer_.size();
      append_key(pointer_, key);
      object[key] = convert(member.second);
      pointer_.resize(above);
    }
    --depth_;
    return object;
  }

  json array_of(const YAML::Node& node) {
    json array = json::array();
    ++depth_;
    for (const auto& element : node) {
      const std::size_t above = pointer_.size();
      append_index(pointer_, array.size());
      array.push_back(convert(element));
      pointer_.resize(above);
    }
    --depth_;
    return array;
  }

  json scalar_of(const YAML::Node& node) {
    const std::string& text = node.Scalar();
    if (text == "...") {
      fail(node, ProblemKind::malformed, "shortened-yaml",
           "\"ros2 topic echo\" left out values here: print the message with --full-length");
    }
    if (node.Tag() == "!") return text;  // quoted
    if (text == "~" || text == "null" || text == "Null" || text == "NULL" || text.empty()) {
      return nullptr;
    }
    if (text == "true" || text == "True" || text == "TRUE") return true;
    if (text == "false" || text == "False" || text == "FALSE") return false;
    if (text == ".nan" || text == ".NaN" || text == ".NAN" || text == ".inf" || text == "-.inf" ||
        text == "+.inf") {
      fail(node, ProblemKind::malformed, "not-finite", text + " is not a finite number");
    }
    if (auto number = number_of(text)) return *std::move(number);
    return text;
  }

  [[noreturn]] void fail(const YAML::Node& node, ProblemKind kind, const char* slug,
                         const std::string& why) const {
    throw Problem{kind, slug, pointer_, place_of(node.Mark()) + ": " + why, {}};
  }

  std::string pointer_;
  std::size_t values_ = 0;
  std::size_t depth_ = 0;
};

Problem malformed(std::string detail) {
  return {ProblemKind::malformed, "malformed-yaml", "", std::move(detail), {}};
}

}  // namespace

Result<std::string> json_of_yaml(std::string_view text) try {
  if (text.find('\0') != std::string_view::npos) {
    return failure(malformed("a YAML text must not contain NUL bytes"));
  }
  std::optional<json> found;
  for (const YAML::Node& document : YAML::LoadAll(std::string(text))) {
    if (!document.IsDefined() || document.IsNull()) continue;
    if (found) {
      return failure(malformed("the text has several documents, found \"---\" at " +
                               place_of(document.Mark()) + ": send each as a request of its own"));
    }
    found = Conversion().convert(document);
  }
  if (!found) return failure(malformed("the text has no document"));
  return found->dump();
} catch (const Problem& problem) {
  return failure(problem);
} catch (const YAML::Exception& error) {
  return failure(malformed(place_of(error.mark) + ": " + error.msg));
} catch (const json::exception& error) {  // invalid UTF-8
  return failure(malformed(error.what()));
}

}  // namespace armloom
