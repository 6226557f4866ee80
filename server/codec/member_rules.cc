#include "server/codec/member_rules.h"

#include <algorithm>
#include <utility>

#include "server/codec/part_groups.h"

namespace armloom::formats {
namespace {

std::string listed(const std::vector<std::string>& keys) {
  std::string text;
  for (const std::string& key : keys) text += (text.empty() ? "" : ", ") + key;
  return text;
}

// Adds a rule to the "allOf" of the schema.
void add_rule(Schema& object, Schema rule) {
  if (!object.contains("allOf")) object["allOf"] = Schema::array();
  object["allOf"].push_back(std::move(rule));
}

Schema has(const std::string& key) { return {{"required", {key}}}; }

class CountRule final : public AnyPart {
 public:
  CountRule(HowMany how_many, std::vector<std::string> keys)
      : how_many_(how_many), keys_(std::move(keys)) {}
  void read_any(const JsonNode& object, void*) const override {
    const auto count =
        std::ranges::count_if(keys_, [&](const std::string& key) { return object.has(key); });
    if (count == 1 || (count == 0 && how_many_ == HowMany::at_most_one)) return;
    const bool is_exact = how_many_ == HowMany::exactly_one;
    object.invalid(is_exact ? "not-exactly-one" : "more-than-one",
                   std::string(is_exact ? "exactly one of " : "at most one of ") + listed(keys_) +
                       (is_exact ? " is required, found " : " is allowed, found ") +
                       std::to_string(count));
  }
  void describe_any(Schema& object, const void*, Way) const override {
    if (how_many_ == HowMany::exactly_one) {
      Schema choices = Schema::array();
      for (const std::string& key : keys_) choices.push_back(has(key));
      return add_rule(object, {{"oneOf", std::move(choices)}});
    }
    for (std::size_t a = 0; a < keys_.size(); ++a) {
      for (std::size_t b = a + 1; b < keys_.size(); ++b) {
        add_rule(object, {{"not", {{"required", {keys_[a], keys_[b]}}}}});
      }
    }
  }

 private:
  HowMany how_many_;
  std::vector<std::string> keys_;
};

class CompanionPart final : public AroundPart {
 public:
  CompanionPart(std::string_view companion, const Access& access, const AnyPartPtr& part)
      : AroundPart(part), companion_(companion), access_(access) {
    part_->list_keys(keys_);
  }
  void read_any(const JsonNode& object, void* out) const override {
    for (const std::string_view key : keys_) check(object, key);
    part_->read_any(object, out);
  }
  void write_any(JsonWriter& out, const void* value) const override {
    access_.use_value(value, [&](const void*) { part_->write_any(out, value); });
  }
  void describe_any(Schema& object, const void* defaults, Way way) const override {
    part_->describe_any(object, defaults, way);
    for (const std::string_view key : keys_) {
      object["dependentRequired"][std::string(key)] = Schema::array({companion_});
    }
  }

 private:
  void check(const JsonNode& object, std::string_view key) const {
    if (!object.has(key) || object.has(companion_)) return;
    object.optional(key, [&](const JsonNode& node) {
      node.invalid("without-companion",
                   "\"" + std::string(key) + "\" requires \"" + companion_ + "\"");
    });
  }

  std::string companion_;
  Access access_;
  std::vector<std::string_view> keys_;
};

// Makes the requirements of a part apply only to objects without `key`. `before`: the schema before
// the part was added.
void describe_unless(Schema& object, const std::string& key, const Schema& before) {
  // Removes the entries that are not in `before` from a list of the schema, and returns them.
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
    if (rule.contains("anyOf")) {  // made by an UnlessPart within this part
      either.insert(either.end(), rule["anyOf"].begin(), rule["anyOf"].end());
    } else {
      either.push_back(rule);
    }
    add_rule(object, {{"anyOf", either}});
  }
}

class UnlessPart final : public AroundPart {
 public:
  UnlessPart(std::string_view key, const AnyPartPtr& part, bool may_be)
      : AroundPart(part), key_(key), may_be_(may_be) {}
  void read_any(const JsonNode& object, void* out) const override {
    if (!object.has(key_)) part_->read_any(object, out);
  }
  void describe_any(Schema& object, const void* defaults, Way way) const override {
    const Schema before = object;
    part_->describe_any(object, defaults, way);
    if (may_be_) describe_unless(object, key_, before);
  }

 private:
  std::string key_;
  bool may_be_;
};

class NotServedPart final : public AnyPart {
 public:
  explicit NotServedPart(NotServed rule) : rule_(std::move(rule)) {}
  void list_keys(std::vector<std::string_view>& keys) const override {
    if (rule_.but_for) keys.push_back(rule_.key);
  }
  void list_refused_keys(std::vector<std::string_view>& keys) const override {
    if (!rule_.but_for) keys.push_back(rule_.key);
  }
  void read_any(const JsonNode& object, void*) const override {
    object.optional(rule_.key, [&](const JsonNode& node) {
      if (!rule_.but_for) return node.invalid(rule_.slug, rule_.sentence);
      std::string text;
      bool flag = false;
      const bool readable = rule_.but_for->is_string() ? node.read(text) : node.read(flag);
      if (readable && node.raw() != *rule_.but_for) node.invalid(rule_.slug, rule_.sentence);
    });
  }
  void describe_any(Schema& object, const void*, Way way) const override {
    if (!rule_.but_for) return;
    describe_member(object, {rule_.key, rule_.text, Need::optional, {}},
                    {{"const", *rule_.but_for}}, std::nullopt, way);
  }

 private:
  NotServed rule_;
};

}  // namespace

AnyPartPtr count_rule(HowMany how_many, std::vector<std::string> keys) {
  return AnyPartPtr(new CountRule(how_many, std::move(keys)));
}

AnyPartPtr only_with(std::string_view companion, const Access& access, const AnyPartPtr& part) {
  return AnyPartPtr(new CompanionPart(companion, access, part));
}

AnyPartPtr unless(std::string_view key, const AnyPartPtr& part, bool may_be) {
  return AnyPartPtr(new UnlessPart(key, part, may_be));
}

AnyPartPtr not_served_part(NotServed rule) {
  return AnyPartPtr(new NotServedPart(std::move(rule)));
}

}  // namespace armloom::formats
