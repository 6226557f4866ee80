#pragma once

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "server/codec/member_part.h"

namespace armloom::formats {

// Several parts as one.
template <class T>
class Parts final : public Part<T> {
 public:
  explicit Parts(std::vector<PartPtr<T>> parts) : parts_(std::move(parts)) {}
  void list_keys(std::vector<std::string_view>& keys) const override {
    for (const auto& part : parts_) part->list_keys(keys);
  }
  void read(const JsonNode& object, T& out) const override {
    for (const auto& part : parts_) part->read(object, out);
  }
  void write(JsonWriter& out, const T& value) const override {
    for (const auto& part : parts_) part->write(out, value);
  }
  void describe(Schema& object, const T& defaults, Way way) const override {
    for (const auto& part : parts_) part->describe(object, defaults, way);
  }
  void map_paths(nlohmann::json& object, const PathMap& map) const override {
    for (const auto& part : parts_) part->map_paths(object, map);
  }

 private:
  std::vector<PartPtr<T>> parts_;
};

template <class T>
[[nodiscard]] PartPtr<T> parts(std::vector<PartPtr<T>> of_it) {
  return make_as_base<Parts<T>>(std::move(of_it));
}

// Members that spell a T in other words: those of a Words, made of the T and back.
template <class T, class Words>
class SpeltPart final : public Part<T> {
 public:
  SpeltPart(std::vector<PartPtr<Words>> parts, Words (*spell)(const T&), T (*mean)(const Words&))
      : parts_(std::move(parts)), spell_(spell), mean_(mean) {}

  void list_keys(std::vector<std::string_view>& keys) const override { parts_.list_keys(keys); }
  void read(const JsonNode& object, T& out) const override {
    Words words{};
    parts_.read(object, words);
    out = mean_(words);
  }
  void write(JsonWriter& out, const T& value) const override { parts_.write(out, spell_(value)); }
  void describe(Schema& object, const T&, Way way) const override {
    parts_.describe(object, Words{}, way);
  }
  void map_paths(nlohmann::json& object, const PathMap& map) const override {
    parts_.map_paths(object, map);
  }

 private:
  Parts<Words> parts_;
  Words (*spell_)(const T&);
  T (*mean_)(const Words&);
};

// Members of this object that make up one value of it: xyz and rpy of a pose.
template <class T, class M>
class InlinePart final : public Part<T> {
 public:
  InlinePart(M T::*where, PartPtr<M> part) : where_(where), part_(std::move(part)) {}

  void list_keys(std::vector<std::string_view>& keys) const override { part_->list_keys(keys); }
  void read(const JsonNode& object, T& out) const override { part_->read(object, out.*where_); }
  void write(JsonWriter& out, const T& value) const override { part_->write(out, value.*where_); }
  void describe(Schema& object, const T& defaults, Way way) const override {
    part_->describe(object, defaults.*where_, way);
  }
  void map_paths(nlohmann::json& object, const PathMap& map) const override {
    part_->map_paths(object, map);
  }

 private:
  M T::*where_;
  PartPtr<M> part_;
};

template <class T, class M>
[[nodiscard]] PartPtr<T> inlined(M T::*where, PartPtr<M> part) {
  return make_as_base<InlinePart<T, M>>(where, std::move(part));
}

}  // namespace armloom::formats
