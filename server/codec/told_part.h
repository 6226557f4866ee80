#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "server/codec/member_part.h"

namespace armloom::formats {

// Members of what the server says: written and described, never read. Get is a member or a function
// of the T. There is no default: what is told stands there always, unless it is told_if().

// What of it does not depend on the member.
template <class T>
class ToldOf : public Part<T> {
 public:
  ToldOf(MemberText text, std::shared_ptr<const Described> format)
      : text_(std::move(text)), format_(std::move(format)) {}

  void list_keys(std::vector<std::string_view>& keys) const override { keys.push_back(text_.key); }
  void read(const JsonNode&, T&) const override {}
  void describe(Schema& object, const T&, Way way) const override {
    describe_member(object, text_, format_->schema(way), std::nullopt, way);
  }

 protected:
  MemberText text_;
  std::shared_ptr<const Described> format_;
};

template <class T, class M, class Get>
class ToldPart final : public ToldOf<T> {
 public:
  ToldPart(MemberText text, FormatPtr<M> format, Get get)
      : ToldOf<T>(std::move(text), std::move(format)), get_(std::move(get)) {}

  void write(JsonWriter& out, const T& value) const override {
    const auto& member = std::invoke(get_, value);
    if constexpr (!std::is_convertible_v<decltype(member), const M&>) {
      if (member) write_as(out, *member);
    } else {
      write_as(out, member);
    }
  }

 private:
  void write_as(JsonWriter& out, const M& member) const {
    out.key(this->text_.key);
    static_cast<const Format<M>&>(*this->format_).write(out, member);
  }

  Get get_;
};

// A ToldPart of whatever T it is put into, at once: it only looks at its texts.
template <class M, class Get>
struct ToldMember {
  std::string_view key;
  std::string_view text;
  Need need;
  FormatPtr<M> format;
  Get get;

  template <class T>
  requires std::is_invocable_v<const Get&, const T&>
  operator PartPtr<T>() const {  // NOLINT: meant to be implicit
    return make_as_base<ToldPart<T, M, Get>>(
        MemberText{std::string(key), std::string(text), need, {}}, format, get);
  }
};

template <class M, class Get>
[[nodiscard]] ToldMember<M, Get> told(std::string_view key, Get get, FormatPtr<M> format,
                                      std::string_view text = "") {
  return {key, text, Need::required, std::move(format), get};
}
// What the T may lack: Get gives an optional, or a pointer that may be null.
template <class M, class Get>
[[nodiscard]] ToldMember<M, Get> told_if(std::string_view key, Get get, FormatPtr<M> format,
                                         std::string_view text = "") {
  return {key, text, Need::optional, std::move(format), get};
}

[[nodiscard]] Schema constant_schema(const Schema& value);
// A member that always has this value: "type": "job".
template <class T>
class ConstantPart final : public Part<T> {
 public:
  ConstantPart(std::string key, Schema value) : key_(std::move(key)), value_(std::move(value)) {}
  void list_keys(std::vector<std::string_view>& keys) const override { keys.push_back(key_); }
  void read(const JsonNode&, T&) const override {}
  void write(JsonWriter& out, const T&) const override { out.key(key_).raw(value_.dump()); }
  void describe(Schema& object, const T&, Way way) const override {
    describe_member(object, {key_, "", Need::required, {}}, constant_schema(value_), std::nullopt,
                    way);
  }

 private:
  std::string key_;
  Schema value_;
};
template <class T>
[[nodiscard]] PartPtr<T> constant(std::string key, Schema value) {
  return make_as_base<ConstantPart<T>>(std::move(key), std::move(value));
}

void describe_times(Schema& object, const std::string& cell_key, const std::string& wall_key,
                    const std::string& text, bool may_lack, Way way);
// "started_s", cell time, and "started_at", wall time; the latter only where the writer knows it.
// Time: TimePoint, or an optional one (null).
template <class T, class Time>
class ToldTimes final : public Part<T> {
 public:
  ToldTimes(std::string what, Time T::*where, std::string text)
      : cell_key_(what + "_s"), wall_key_(what + "_at"), where_(where), text_(std::move(text)) {}

  void list_keys(std::vector<std::string_view>& keys) const override {
    keys.push_back(cell_key_);
    keys.push_back(wall_key_);
  }
  void read(const JsonNode&, T&) const override {}
  void write(JsonWriter& out, const T& value) const override {
    out.field(cell_key_, value.*where_);
    if (out.knows_wall_time()) out.key(wall_key_).wall_time(value.*where_);
  }
  void describe(Schema& object, const T&, Way way) const override {
    constexpr bool kMayLack = !std::is_same_v<Time, TimePoint>;
    describe_times(object, cell_key_, wall_key_, text_, kMayLack, way);
  }

 private:
  std::string cell_key_;
  std::string wall_key_;
  Time T::*where_;
  std::string text_;
};
template <class T, class Time>
[[nodiscard]] PartPtr<T> told_times(std::string what, Time T::*where, std::string text) {
  return make_as_base<ToldTimes<T, Time>>(std::move(what), where, std::move(text));
}

}  // namespace armloom::formats
