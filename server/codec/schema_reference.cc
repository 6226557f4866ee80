#include "server/codec/schema_reference.h"

#include <array>
#include <utility>
#include <vector>

namespace armloom {
namespace {

std::string code(const std::string& text) { return "`" + text + "`"; }

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string range_words(const Schema& schema) {
  const auto at = [&](const char* key) { return schema[key].dump(); };
  if (schema.contains("minimum") && schema.contains("maximum")) {
    return at("minimum") + " to " + at("maximum");
  }
  std::vector<std::string> words;
  if (schema.contains("minimum")) words.push_back("at least " + at("minimum"));
  if (schema.contains("exclusiveMinimum")) words.push_back("above " + at("exclusiveMinimum"));
  if (schema.contains("maximum")) words.push_back("at most " + at("maximum"));
  if (schema.contains("exclusiveMaximum")) words.push_back("below " + at("exclusiveMaximum"));
  return joined(words, ", ");
}

std::string type_words(const Schema& schema, const std::string& key);

std::string array_words(const Schema& schema) {
  const Schema& items = schema["items"];
  const bool fixed = schema.contains("minItems") && schema.contains("maxItems");
  if (fixed) {
    const std::string of = items["type"] == "number" ? " number" : " text";
    const auto size = schema["minItems"].get<std::size_t>();
    const std::string range = range_words(items);
    return std::to_string(size) + of + (size > 1 ? "s" : "") + (range.empty() ? "" : ", ") + range;
  }
  std::string words = "list";
  if (!items.contains("properties")) {
    words += " of " + (items["type"] == "number" ? "numbers" : "[" + type_words(items, "") + "]");
  }
  if (schema.contains("minItems")) words += ", at least " + schema["minItems"].dump();
  return words;
}

// Returns, for example, "m, 0 to 1".
std::string type_words(const Schema& schema, const std::string& key) {
  if (schema.contains("anyOf")) {
    std::vector<std::string> words;
    for (const Schema& choice : schema["anyOf"]) words.push_back(type_words(choice, key));
    return joined(words, " or ");
  }
  if (schema.contains("enum")) {
    std::vector<std::string> words;
    for (const Schema& choice : schema["enum"]) words.push_back(code(choice.get<std::string>()));
    return joined(words, ", ");
  }
  const std::string type = schema["type"];
  if (type == "array") return array_words(schema);
  if (type == "string") return "text";
  if (type == "object") {
    if (schema.contains("properties")) return "object";
    return "object: name → " + type_words(schema["additionalProperties"], key);
  }
  const std::string unit = unit_of_key(key);
  const std::string range = range_words(schema);
  return (unit.empty() ? type : unit) + (range.empty() ? "" : ", ") + range;
}

bool is_required(const Schema& object, const std::string& key) {
  if (!object.contains("required")) return false;
  for (const Schema& name : object["required"]) {
    if (name == key) return true;
  }
  return false;
}

std::string rules_words(const Schema& object) {
  std::string text;
  if (object.contains("allOf")) {
    for (const Schema& rule : object["allOf"]) {
      if (!rule.contains("oneOf")) continue;
      std::vector<std::string> keys;
      for (const Schema& choice : rule["oneOf"]) keys.push_back(code(choice["required"][0]));
      text += "Exactly one of " + joined(keys, ", ") + ". ";
    }
  }
  if (object.contains("dependentRequired")) {
    for (const auto& [key, others] : object["dependentRequired"].items()) {
      text += code(key) + " only with " + code(others[0]) + ". ";
    }
  }
  if (!text.empty()) text.back() = '\n';
  return text;
}

class ReferenceWriter {
 public:
  // `place`: "robots[].arms[]"; empty for the outermost object.
  void write_object(const Schema& object, const std::string& place, const std::string& about) {
    text_ += "## " + (place.empty() ? std::string("The whole file") : code(place)) + "\n\n";
    if (!place.empty()) text_ += about + "\n\n";
    text_ += "| field | value | default | |\n|---|---|---|---|\n";
    for (const auto& [key, member] : object["properties"].items()) {
      const bool required = is_required(object, key);
      text_ += "| " + code(key) + " | " + type_words(member, key) + " | " +
               (required                     ? "required"
                : member.contains("default") ? code(shown(member["default"]))
                                             : "") +
               " | " + member["description"].get<std::string>() + " |\n";
    }
    const std::string rules = rules_words(object);
    text_ += (rules.empty() ? "" : "\n") + rules + "\n";
    for (const auto& [key, member] : object["properties"].items()) {
      const std::string below = place.empty() ? key : place + "." + key;
      find_objects(member, below, member["description"]);
    }
  }
  std::string take() {
    text_.pop_back();  // the empty line after the last section
    return std::move(text_);
  }

 private:
  static std::string shown(const Schema& value) {
    std::string text = value.dump();
    for (std::size_t at = 0; (at = text.find(',', at)) != text.npos; at += 2)
      text.insert(at + 1, " ");
    return text;
  }
  void find_objects(const Schema& schema, const std::string& place, const std::string& about) {
    if (schema.contains("properties")) return write_object(schema, place, about);
    if (schema.contains("items")) return find_objects(schema["items"], place + "[]", about);
    if (schema.contains("additionalProperties")) {
      find_objects(schema["additionalProperties"], place + ".<name>", about);
    }
  }

  std::string text_;
};

}  // namespace

std::string unit_of_key(const std::string& key) {
  // Longer endings first: "velocity_rad_s" ends in "_s" as well.
  static constexpr std::array<std::pair<const char*, const char*>, 11> kUnits{{
      {"_rad_s3", "rad/s³"},
      {"_rad_s2", "rad/s²"},
      {"_rad_s", "rad/s"},
      {"_rad", "rad"},
      {"_m_s3", "m/s³"},
      {"_m_s2", "m/s²"},
      {"_m_s", "m/s"},
      {"_m", "m"},
      {"_hz", "Hz"},
      {"_s", "s"},
      {"_at", "RFC 3339"},
  }};
  for (const auto& [ending, unit] : kUnits) {
    if (key.ends_with(ending)) return unit;
  }
  return "";
}

std::string schema_reference(const Schema& schema) {
  ReferenceWriter writer;
  writer.write_object(schema, "", "");
  return writer.take();
}

}  // namespace armloom
