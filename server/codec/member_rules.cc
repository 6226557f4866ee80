#include "server/codec/member_rules.h"

#include <algorithm>

namespace armloom::formats {
namespace {

std::string listed(const std::vector<std::string>& keys) {
  std::string text;
  for (const std::string& key : keys) text += (text.empty() ? "" : ", ") + key;
  return text;
}

// A rule of its own beside those that the object has.
void add_rule(Schema& object, Schema rule) {
  if (!object.contains("allOf")) object["allOf"] = Schema::array();
  object["allOf"].push_back(std::move(rule));
}

Schema has(const std::string& key) { return {{"required", {key}}}; }

}  // namespace

void check_count(const JsonNode& object, HowMany how_many, const std::vector<std::string>& keys) {
  const auto count =
      std::ranges::count_if(keys, [&](const std::string& key) { return object.has(key); });
  if (count == 1 || (count == 0 && how_many == HowMany::at_most_one)) return;
  const std::string expected = how_many == HowMany::exactly_one ? "exactly" : "at most";
  object.invalid(
      how_many == HowMany::exactly_one ? "not-exactly-one" : "more-than-one",
      expected + " one of " + listed(keys) + " is expected, found " + std::to_string(count));
}

void describe_count(Schema& object, HowMany how_many, const std::vector<std::string>& keys) {
  if (how_many == HowMany::exactly_one) {
    Schema choices = Schema::array();
    for (const std::string& key : keys) choices.push_back(has(key));
    add_rule(object, {{"oneOf", std::move(choices)}});
    return;
  }
  for (std::size_t a = 0; a < keys.size(); ++a) {
    for (std::size_t b = a + 1; b < keys.size(); ++b) {
      add_rule(object, {{"not", {{"required", {keys[a], keys[b]}}}}});
    }
  }
}

void check_companion(const JsonNode& object, std::string_view key, const std::string& companion) {
  if (!object.has(key) || object.has(companion)) return;
  object.optional(key, [&](const JsonNode& node) {
    node.invalid("without-companion", "only a " + companion + " has a " + std::string(key));
  });
}

void describe_companion(Schema& object, std::string_view key, const std::string& companion) {
  object["dependentRequired"][std::string(key)] = Schema::array({companion});
}

void describe_unless(Schema& object, const std::string& key, const Schema& before) {
  // The entries of a list that `before` does not have; they are taken out.
  const auto take_new = [&](const char* list) {
    const Schema all = object.value(list, Schema::array());
    const Schema old = before.value(list, Schema::array());
    object.erase(list);
    if (!old.empty()) object[list] = old;
    return Schema(all.begin() + static_cast<std::ptrdiff_t>(old.size()), all.end());
  };
  const Schema needed = take_new("required");
  Schema rules = take_new("allOf");
  if (!needed.empty()) rules.push_back({{"required", needed}});
  for (const Schema& rule : rules) {
    Schema either{has(key)};
    if (rule.contains("anyOf")) {  // of another one around the same part
      either.insert(either.end(), rule["anyOf"].begin(), rule["anyOf"].end());
    } else {
      either.push_back(rule);
    }
    add_rule(object, {{"anyOf", either}});
  }
}

void check_not_served(const JsonNode& object, const NotServed& rule) {
  object.optional(rule.key, [&](const JsonNode& node) {
    if (!rule.but_for) return node.invalid(rule.slug, rule.sentence);
    std::string text;
    bool flag = false;
    const bool readable = rule.but_for->is_string() ? node.read(text) : node.read(flag);
    if (readable && node.raw() != *rule.but_for) node.invalid(rule.slug, rule.sentence);
  });
}

void describe_not_served(Schema& object, const NotServed& rule, Way way) {
  if (!rule.but_for) return;
  describe_member(object, {rule.key, rule.text, Need::optional, {}}, {{"const", *rule.but_for}},
                  std::nullopt, way);
}

}  // namespace armloom::formats
