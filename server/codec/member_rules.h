#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/codec/member_part.h"

namespace armloom::formats {

// Rules over several members of an object.

enum class HowMany { exactly_one, at_most_one };
void check_count(const JsonNode& object, HowMany how_many, const std::vector<std::string>& keys);
void describe_count(Schema& object, HowMany how_many, const std::vector<std::string>& keys);
void check_companion(const JsonNode& object, const std::string& key, const std::string& companion);
void describe_companion(Schema& object, const std::string& key, const std::string& companion);

template <class T>
class CountRule final : public Part<T> {
 public:
  CountRule(HowMany how_many, std::vector<std::string> keys)
      : how_many_(how_many), keys_(std::move(keys)) {}
  void read(const JsonNode& object, T&) const override { check_count(object, how_many_, keys_); }
  void describe(Schema& object, const T&) const override {
    describe_count(object, how_many_, keys_);
  }

 private:
  HowMany how_many_;
  std::vector<std::string> keys_;
};
template <class T>
[[nodiscard]] PartPtr<T> exactly_one(std::vector<std::string> keys) {
  return std::make_shared<CountRule<T>>(HowMany::exactly_one, std::move(keys));
}
template <class T>
[[nodiscard]] PartPtr<T> at_most_one(std::vector<std::string> keys) {
  return std::make_shared<CountRule<T>>(HowMany::at_most_one, std::move(keys));
}

// `key` has no meaning without `companion`.
template <class T>
class CompanionRule final : public Part<T> {
 public:
  CompanionRule(std::string key, std::string companion)
      : key_(std::move(key)), companion_(std::move(companion)) {}
  void read(const JsonNode& object, T&) const override {
    check_companion(object, key_, companion_);
  }
  void describe(Schema& object, const T&) const override {
    describe_companion(object, key_, companion_);
  }

 private:
  std::string key_;
  std::string companion_;
};
template <class T>
[[nodiscard]] PartPtr<T> only_with(std::string companion, std::string key) {
  return std::make_shared<CompanionRule<T>>(std::move(key), std::move(companion));
}

}  // namespace armloom::formats
