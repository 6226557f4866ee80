#pragma once

#include <cstddef>
#include <utility>

#include "server/codec/member_access.h"
#include "server/codec/part.h"

namespace armloom::formats {

[[nodiscard]] AnyPartPtr parts(AnyParts of_it);
template <class T>
[[nodiscard]] PartPtr<T> parts(PartList<T> of_it) {
  return PartPtr<T>(parts(of_it.any()));
}

// Base class of parts that wrap another part.
class AroundPart : public AnyPart {
 public:
  explicit AroundPart(const AnyPartPtr& part) : part_(part) {}
  void list_keys(std::vector<std::string_view>& keys) const override { part_->list_keys(keys); }
  void list_refused_keys(std::vector<std::string_view>& keys) const override {
    part_->list_refused_keys(keys);
  }
  void read_any(const JsonNode& object, void* out) const override { part_->read_any(object, out); }
  void write_any(JsonWriter& out, const void* value) const override {
    part_->write_any(out, value);
  }
  void describe_any(Schema& object, const void* defaults, Way way) const override {
    part_->describe_any(object, defaults, way);
  }
  void map_paths(nlohmann::json& object, const PathMap& map) const override {
    part_->map_paths(object, map);
  }

 protected:
  AnyPartPtr part_;
};

// A value of type T that is written as the members of another type, Words: for example a pose as
// xyz and rpy. `spell` converts a T to Words (it may return a reference), `mean` converts Words to
// a T.
template <class T, class Words, class Spell>
class SpeltPart final : public AroundPart {
 public:
  SpeltPart(const AnyPartPtr& words, Spell spell, T (*mean)(const Words&))
      : AroundPart(words), spell_(spell), mean_(mean) {}

  void read_any(const JsonNode& object, void* out) const override {
    Words words{};
    part_->read_any(object, &words);
    *static_cast<T*>(out) = mean_(words);
  }
  void write_any(JsonWriter& out, const void* value) const override {
    const Words& words = spell_(*static_cast<const T*>(value));
    part_->write_any(out, &words);
  }
  void describe_any(Schema& object, const void*, Way way) const override {
    const Words words{};
    part_->describe_any(object, &words, way);
  }

 private:
  Spell spell_;
  T (*mean_)(const Words&);
};
template <class T, class Words, class Spell>
[[nodiscard]] PartPtr<T> spelt(const PartList<Words>& words, Spell spell, T (*mean)(const Words&)) {
  return PartPtr<T>(AnyPartPtr(new SpeltPart<T, Words, Spell>(parts(words.any()), spell, mean)));
}

// Describes a value whose members are written directly into the enclosing JSON object: for example
// xyz and rpy of a pose.
[[nodiscard]] AnyPartPtr inlined(std::ptrdiff_t offset, const AnyPartPtr& part);
template <class T, class M>
[[nodiscard]] PartPtr<T> inlined(M T::*where, const PartPtr<M>& part) {
  return PartPtr<T>(inlined(offset_of(where), part.any()));
}

}  // namespace armloom::formats
