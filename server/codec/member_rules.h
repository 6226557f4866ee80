#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/codec/member_part.h"

namespace armloom::formats {

// Rules over several members of an object.

enum class HowMany { exactly_one, at_most_one };
void check_count(const JsonNode& object, HowMany how_many, const std::vector<std::string>& keys);
void describe_count(Schema& object, HowMany how_many, const std::vector<std::string>& keys);
void check_companion(const JsonNode& object, std::string_view key, const std::string& companion);
void describe_companion(Schema& object, std::string_view key, const std::string& companion);

template <class T>
class CountRule final : public Part<T> {
 public:
  CountRule(HowMany how_many, std::vector<std::string> keys)
      : how_many_(how_many), keys_(std::move(keys)) {}
  void read(const JsonNode& object, T&) const override { check_count(object, how_many_, keys_); }
  void describe(Schema& object, const T&, Way) const override {
    describe_count(object, how_many_, keys_);
  }

 private:
  HowMany how_many_;
  std::vector<std::string> keys_;
};
template <class T>
[[nodiscard]] PartPtr<T> exactly_one(std::vector<std::string> keys) {
  return make_as_base<CountRule<T>>(HowMany::exactly_one, std::move(keys));
}
template <class T>
[[nodiscard]] PartPtr<T> at_most_one(std::vector<std::string> keys) {
  return make_as_base<CountRule<T>>(HowMany::at_most_one, std::move(keys));
}

// The part, which has no meaning without the member `companion`, and is not written without it.
template <class T, class M>
class CompanionPart final : public Part<T> {
 public:
  CompanionPart(std::string companion, std::optional<M> T::*where, PartPtr<T> part)
      : companion_(std::move(companion)), where_(where), part_(std::move(part)) {
    part_->list_keys(keys_);
  }
  void list_keys(std::vector<std::string_view>& keys) const override { part_->list_keys(keys); }
  void read(const JsonNode& object, T& out) const override {
    for (const std::string_view key : keys_) check_companion(object, key, companion_);
    part_->read(object, out);
  }
  void write(JsonWriter& out, const T& value) const override {
    if (value.*where_) part_->write(out, value);
  }
  void describe(Schema& object, const T& defaults, Way way) const override {
    part_->describe(object, defaults, way);
    for (const std::string_view key : keys_) describe_companion(object, key, companion_);
  }
  void map_paths(nlohmann::json& object, const PathMap& map) const override {
    part_->map_paths(object, map);
  }

 private:
  std::string companion_;
  std::optional<M> T::*where_;
  PartPtr<T> part_;
  std::vector<std::string_view> keys_;
};
template <class T, class M>
[[nodiscard]] PartPtr<T> only_with(std::string companion, std::optional<M> T::*where,
                                   PartPtr<T> part) {
  return make_as_base<CompanionPart<T, M>>(std::move(companion), where, std::move(part));
}

// What `object` demands beyond `before`, its description without the part, it demands only without
// `key`.
void describe_unless(Schema& object, const std::string& key, const Schema& before);

// The part, where the object has no member of that name.
template <class T>
class UnlessPart final : public Part<T> {
 public:
  // `may_be`: there are objects with that member.
  UnlessPart(std::string key, PartPtr<T> part, bool may_be)
      : key_(std::move(key)), part_(std::move(part)), may_be_(may_be) {}
  void list_keys(std::vector<std::string_view>& keys) const override { part_->list_keys(keys); }
  void read(const JsonNode& object, T& out) const override {
    if (!object.has(key_)) part_->read(object, out);
  }
  void write(JsonWriter& out, const T& value) const override { part_->write(out, value); }
  void describe(Schema& object, const T& defaults, Way way) const override {
    const Schema before = object;
    part_->describe(object, defaults, way);
    if (may_be_) describe_unless(object, key_, before);
  }

 private:
  std::string key_;
  PartPtr<T> part_;
  bool may_be_;
};
template <class T>
[[nodiscard]] PartPtr<T> unless(std::string key, PartPtr<T> part) {
  return make_as_base<UnlessPart<T>>(std::move(key), std::move(part), true);
}
// The same beside a member that is refused (not_served): that is fault enough.
template <class T>
[[nodiscard]] PartPtr<T> unless_refused(std::string key, PartPtr<T> part) {
  return make_as_base<UnlessPart<T>>(std::move(key), std::move(part), false);
}

// A member that clients may know of and that is not served: at all, or but for one value, which is
// what is done anyway. Everything else is the fault `slug` with `sentence`.
struct NotServed {
  std::string key;
  std::string slug;
  std::string sentence;
  std::optional<nlohmann::json> but_for = {};
  std::string text = "";  // for the schema, which does not know the member when nothing is served
};
void check_not_served(const JsonNode& object, const NotServed& rule);
void describe_not_served(Schema& object, const NotServed& rule, Way way);
template <class T>
class NotServedPart final : public Part<T> {
 public:
  explicit NotServedPart(NotServed rule) : rule_(std::move(rule)) {}
  void list_keys(std::vector<std::string_view>& keys) const override { keys.push_back(rule_.key); }
  void read(const JsonNode& object, T&) const override { check_not_served(object, rule_); }
  void describe(Schema& object, const T&, Way way) const override {
    describe_not_served(object, rule_, way);
  }

 private:
  NotServed rule_;
};
template <class T>
[[nodiscard]] PartPtr<T> not_served(NotServed rule) {
  return make_as_base<NotServedPart<T>>(std::move(rule));
}

}  // namespace armloom::formats
