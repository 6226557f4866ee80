#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/codec/format.h"

namespace armloom::formats {

// A part of the description of a JSON object that stands for a T: one member, several members that
// make up one value, or a rule over members.
template <class T>
class Part {
 public:
  using Base = Part;
  virtual ~Part() = default;
  virtual void list_keys(std::vector<std::string_view>& keys) const { static_cast<void>(keys); }
  virtual void read(const JsonNode& object, T& out) const = 0;
  // Keys with their values.
  virtual void write(JsonWriter& out, const T& value) const {
    static_cast<void>(out);
    static_cast<void>(value);
  }
  // Adds to the schema of the object: "properties", "required". What `defaults` holds is what an
  // absent member means.
  virtual void describe(Schema& object, const T& defaults, Way way) const = 0;
  virtual void map_paths(nlohmann::json& object, const PathMap& map) const {
    static_cast<void>(object);
    static_cast<void>(map);
  }
};

template <class T>
using PartPtr = std::shared_ptr<const Part<T>>;

enum class Need { required, optional };

// What the schema says of a member besides its format.
struct MemberText {
  std::string key;
  std::string text;  // one sentence or two
  Need need = Need::optional;
  std::optional<Schema> stated;  // default, where the value itself has none
};

// `fallback`: what an absent one means; none: it is then simply not there.
void describe_member(Schema& object, const MemberText& member, Schema schema,
                     const std::optional<Schema>& fallback, Way way);

// A value to read into; Eigen leaves its own as they come.
template <class M>
[[nodiscard]] M fresh() {
  if constexpr (requires { M::Zero(); }) {
    return M::Zero();
  } else {
    return M{};
  }
}

// One member of the object. Get(const T&) gives the value, or an optional that is empty where the
// member is absent; Put(T&, M) stores what was read.
template <class T, class M>
class MemberPart final : public Part<T> {
 public:
  using Get = std::function<std::optional<M>(const T&)>;
  using Put = std::function<void(T&, M)>;
  MemberPart(MemberText text, FormatPtr<M> format, Get get, Put put)
      : text_(std::move(text)),
        format_(std::move(format)),
        get_(std::move(get)),
        put_(std::move(put)) {}

  void list_keys(std::vector<std::string_view>& keys) const override { keys.push_back(text_.key); }
  void read(const JsonNode& object, T& out) const override {
    const auto take = [&](const JsonNode& node) {
      M value = get_(out).value_or(fresh<M>());
      format_->read(node, value);
      put_(out, std::move(value));
    };
    if (text_.need == Need::required) {
      object.required(text_.key, take);
    } else {
      object.optional(text_.key, take);
    }
  }
  void write(JsonWriter& out, const T& value) const override {
    const std::optional<M> member = get_(value);
    if (!member) return;
    out.key(text_.key);
    format_->write(out, *member);
  }
  void describe(Schema& object, const T& defaults, Way way) const override {
    const std::optional<M> fallback = get_(defaults);
    describe_member(object, text_, format_->schema(way),
                    fallback ? std::optional(as_json(*format_, *fallback)) : std::nullopt, way);
  }
  void map_paths(nlohmann::json& object, const PathMap& map) const override {
    if (const auto it = object.find(text_.key); it != object.end()) format_->map_paths(*it, map);
  }

 private:
  MemberText text_;
  FormatPtr<M> format_;
  Get get_;
  Put put_;
};

// An empty list, dictionary or text is written as nothing: it is what an absent one means.
template <class T, class M>
[[nodiscard]] PartPtr<T> member(MemberText text, M T::*where, FormatPtr<M> format) {
  return make_as_base<MemberPart<T, M>>(
      std::move(text), std::move(format),
      [where](const T& from) -> std::optional<M> {
        if constexpr (requires { (from.*where).empty(); }) {
          if ((from.*where).empty()) return std::nullopt;
        }
        return from.*where;
      },
      [where](T& to, M value) { to.*where = std::move(value); });
}
// A value that the object may leave open.
template <class T, class M>
[[nodiscard]] PartPtr<T> member(MemberText text, std::optional<M> T::*where, FormatPtr<M> format) {
  return make_as_base<MemberPart<T, M>>(
      std::move(text), std::move(format), [where](const T& from) { return from.*where; },
      [where](T& to, M value) { to.*where = std::move(value); });
}

// The usual ones: key, member, format, what it means.
template <class T, class Where, class M>
[[nodiscard]] PartPtr<T> required(std::string_view key, Where T::*where, FormatPtr<M> format,
                                  std::string_view text) {
  return member({std::string(key), std::string(text), Need::required, {}}, where,
                std::move(format));
}
template <class T, class Where, class M>
[[nodiscard]] PartPtr<T> field(std::string_view key, Where T::*where, FormatPtr<M> format,
                               std::string_view text, std::optional<Schema> stated = std::nullopt) {
  return member({std::string(key), std::string(text), Need::optional, std::move(stated)}, where,
                std::move(format));
}

// A member that is always there, empty or not. `spell` makes of the value what is written, `mean`
// the value of what is read.
template <class T, class Where, class M, class Spell = std::identity, class Mean = std::identity>
[[nodiscard]] PartPtr<T> always(std::string_view key, Where T::*where, FormatPtr<M> format,
                                std::string_view text = "", Spell spell = {}, Mean mean = {}) {
  return make_as_base<MemberPart<T, M>>(
      MemberText{std::string(key), std::string(text), Need::required, {}}, std::move(format),
      [where, spell](const T& from) -> std::optional<M> {
        return std::optional<M>(std::in_place, spell(from.*where));
      },
      [where, mean](T& to, M value) { to.*where = mean(std::move(value)); });
}

// A value that is told only where it is not the usual one.
template <class T, class M>
[[nodiscard]] PartPtr<T> unless_usual(std::string_view key, M T::*where, M usual,
                                      FormatPtr<M> format, std::string_view text) {
  const Schema stated = as_json(*format, usual);
  return make_as_base<MemberPart<T, M>>(
      MemberText{std::string(key), std::string(text), Need::optional, stated}, std::move(format),
      [where, usual](const T& from) {
        return from.*where == usual ? std::nullopt : std::optional<M>(from.*where);
      },
      [where](T& to, M value) { to.*where = std::move(value); });
}

// A part that is read, described as what may come in, and never written.
template <class T>
class ReadOnlyPart final : public Part<T> {
 public:
  explicit ReadOnlyPart(PartPtr<T> part) : part_(std::move(part)) {}
  void list_keys(std::vector<std::string_view>& keys) const override { part_->list_keys(keys); }
  void read(const JsonNode& object, T& out) const override { part_->read(object, out); }
  void describe(Schema& object, const T& defaults, Way way) const override {
    if (way == Way::in) part_->describe(object, defaults, way);
  }
  void map_paths(nlohmann::json& object, const PathMap& map) const override {
    part_->map_paths(object, map);
  }

 private:
  PartPtr<T> part_;
};
template <class T>
[[nodiscard]] PartPtr<T> read_only(PartPtr<T> part) {
  return make_as_base<ReadOnlyPart<T>>(std::move(part));
}

// A member that is allowed and means nothing here.
template <class T, class M>
[[nodiscard]] PartPtr<T> ignored(std::string key, FormatPtr<M> format, std::string text) {
  return make_as_base<MemberPart<T, M>>(
      MemberText{std::move(key), std::move(text), Need::optional, {}}, std::move(format),
      [](const T&) { return std::optional<M>(); }, [](T&, M) {});
}

}  // namespace armloom::formats
