#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/codec/format.h"

namespace armloom::formats {

// How many elements a list may have. One with more than `most` is not read at all: the fault
// "too-many-<what>" counts them as `noun`.
struct ListSize {
  std::size_t fewest = 0;
  std::optional<std::size_t> most = {};
  std::string noun = "elements";
  std::string what = noun;
};
[[nodiscard]] bool is_readable(const JsonNode& array, const ListSize& size);
void check_fewest(const JsonNode& array, const ListSize& size);
// Of arrays and objects, by the schema of what is in them.
[[nodiscard]] Schema list_schema(Schema element, const ListSize& size);
[[nodiscard]] Schema dictionary_schema(Schema member);
[[nodiscard]] Schema pair_schema(Schema element);

// A JSON array of elements that all have one format.
template <class T>
class ListFormat final : public Format<std::vector<T>> {
 public:
  ListFormat(FormatPtr<T> element, ListSize size)
      : element_(std::move(element)), size_(std::move(size)) {}

  void read(const JsonNode& node, std::vector<T>& out) const override {
    out.clear();
    if (!node.array() || !is_readable(node, size_)) return;
    out.reserve(node.raw().size());
    node.each([&](const JsonNode& element) { element_->read(element, out.emplace_back()); });
    check_fewest(node, size_);
  }
  void write(JsonWriter& out, const std::vector<T>& list) const override {
    out.begin_array();
    for (const T& element : list) element_->write(out, element);
    out.end_array();
  }
  Schema schema(Way way) const override { return list_schema(element_->schema(way), size_); }
  void map_paths(nlohmann::json& value, const PathMap& map) const override {
    if (!value.is_array()) return;
    for (auto& element : value) element_->map_paths(element, map);
  }

 private:
  FormatPtr<T> element_;
  ListSize size_;
};

template <class T>
[[nodiscard]] FormatPtr<std::vector<T>> list(FormatPtr<T> element, ListSize size = {}) {
  return make_as_base<ListFormat<T>>(std::move(element), std::move(size));
}

// A JSON object whose keys are names of the user's: {"torso_lift_joint": 0.1}.
template <class T>
class DictionaryFormat final : public Format<std::map<std::string, T>> {
 public:
  explicit DictionaryFormat(FormatPtr<T> member) : member_(std::move(member)) {}

  void read(const JsonNode& node, std::map<std::string, T>& out) const override {
    node.members(
        [&](const std::string& key, const JsonNode& member) { member_->read(member, out[key]); });
  }
  void write(JsonWriter& out, const std::map<std::string, T>& members) const override {
    out.begin_object();
    for (const auto& [key, member] : members) {
      out.key(key);
      member_->write(out, member);
    }
    out.end_object();
  }
  Schema schema(Way way) const override { return dictionary_schema(member_->schema(way)); }
  void map_paths(nlohmann::json& value, const PathMap& map) const override {
    if (!value.is_object()) return;
    for (auto& [key, member] : value.items()) member_->map_paths(member, map);
  }

 private:
  FormatPtr<T> member_;
};

template <class T>
[[nodiscard]] FormatPtr<std::map<std::string, T>> dictionary(FormatPtr<T> member) {
  return make_as_base<DictionaryFormat<T>>(std::move(member));
}

// An array of exactly two: ["table", "panda_link0"].
template <class T>
class PairFormat final : public Format<std::pair<T, T>> {
 public:
  explicit PairFormat(FormatPtr<T> element) : element_(std::move(element)) {}

  void read(const JsonNode& node, std::pair<T, T>& out) const override {
    if (!node.array()) return;
    if (node.raw().size() != 2) {
      return node.invalid("wrong-size",
                          "expected a pair, found " + std::to_string(node.raw().size()));
    }
    T* next = &out.first;
    node.each([&](const JsonNode& element) {
      element_->read(element, *next);
      next = &out.second;
    });
  }
  void write(JsonWriter& out, const std::pair<T, T>& pair) const override {
    out.begin_array();
    element_->write(out, pair.first);
    element_->write(out, pair.second);
    out.end_array();
  }
  Schema schema(Way way) const override { return pair_schema(element_->schema(way)); }

 private:
  FormatPtr<T> element_;
};

template <class T>
[[nodiscard]] FormatPtr<std::pair<T, T>> pair_of(FormatPtr<T> element) {
  return make_as_base<PairFormat<T>>(std::move(element));
}

}  // namespace armloom::formats
