#include "server/codec/member_part.h"

#include "server/codec/later_part.h"
#include "server/codec/output_part.h"
#include "server/codec/part_groups.h"

namespace armloom::formats {
namespace {

// Returns true if a schema should show this default: not for objects and empty lists.
bool is_telling(const Schema& fallback) {
  return !fallback.is_object() && !(fallback.is_array() && fallback.empty());
}

class MemberPart : public AnyPart {
 public:
  MemberPart(MemberText text, const AnyFormatPtr& format, const Access& access)
      : text_(std::move(text)), format_(format), access_(access) {}

  void list_keys(std::vector<std::string_view>& keys) const override { keys.push_back(text_.key); }
  void read_any(const JsonNode& object, void* out) const override {
    const auto take = [&](const JsonNode& node) {
      access_.fill_value(out, [&](void* value) { format_->read_any(node, value); });
    };
    if (text_.need == Need::required) {
      object.required(text_.key, take, text_.give);
    } else {
      object.optional(text_.key, take);
    }
  }
  void write_any(JsonWriter& out, const void* object) const override {
    access_.use_value(object, [&](const void* value) {
      out.key(text_.key);
      format_->write_any(out, value);
    });
  }
  void describe_any(Schema& object, const void* defaults, Way way) const override {
    std::optional<Schema> fallback;
    access_.use_value(defaults, [&](const void* value) { fallback = as_json(*format_, value); });
    describe_member(object, text_, format_->schema(way), fallback, way);
  }
  void map_paths(nlohmann::json& object, const PathMap& map) const override {
    if (const auto it = object.find(text_.key); it != object.end()) format_->map_paths(*it, map);
  }

 protected:
  MemberText text_;
  AnyFormatPtr format_;

 private:
  Access access_;
};

class OutputPart final : public MemberPart {
 public:
  using MemberPart::MemberPart;
  void read_any(const JsonNode&, void*) const override {}
  void describe_any(Schema& object, const void*, Way way) const override {
    describe_member(object, text_, format_->schema(way), std::nullopt, way);
  }
};

class ConstantPart final : public AnyPart {
 public:
  ConstantPart(std::string_view key, const Schema& value)
      : key_(key), value_(value), text_(value.dump()) {}
  void list_keys(std::vector<std::string_view>& keys) const override { keys.push_back(key_); }
  void read_any(const JsonNode&, void*) const override {}
  void write_any(JsonWriter& out, const void*) const override { out.key(key_).raw(text_); }
  void describe_any(Schema& object, const void*, Way way) const override {
    describe_member(object, {key_, "", Need::required, {}}, {{"const", value_}}, std::nullopt, way);
  }

 private:
  std::string key_;
  Schema value_;
  std::string text_;
};

class ToldTimes final : public AnyPart {
 public:
  ToldTimes(std::string_view what, std::ptrdiff_t offset, bool may_lack, std::string_view text)
      : cell_key_(std::string(what) + "_s"),
        wall_key_(std::string(what) + "_at"),
        offset_(offset),
        may_lack_(may_lack),
        text_(text) {}

  void list_keys(std::vector<std::string_view>& keys) const override {
    keys.push_back(cell_key_);
    keys.push_back(wall_key_);
  }
  void read_any(const JsonNode&, void*) const override {}
  void write_any(JsonWriter& out, const void* object) const override {
    const void* where = address_at(object, offset_);
    const auto time = may_lack_ ? *static_cast<const std::optional<TimePoint>*>(where)
                                : *static_cast<const TimePoint*>(where);
    out.field(cell_key_, time);
    if (out.knows_wall_time()) out.key(wall_key_).wall_time(time);
  }
  void describe_any(Schema& object, const void*, Way way) const override {
    const auto type = [this](const char* name) -> Schema {
      return may_lack_ ? Schema{name, "null"} : Schema(name);
    };
    describe_member(object, {cell_key_, text_ + ", in cell time", Need::required, {}},
                    {{"type", type("number")}}, std::nullopt, way);
    describe_member(object, {wall_key_, "The same in wall time", Need::required, {}},
                    {{"type", type("string")}, {"format", "date-time"}}, std::nullopt, way);
  }

 private:
  std::string cell_key_;
  std::string wall_key_;
  std::ptrdiff_t offset_;
  bool may_lack_;
  std::string text_;
};

class ReadOnlyPart final : public AroundPart {
 public:
  using AroundPart::AroundPart;
  void write_any(JsonWriter&, const void*) const override {}
  void describe_any(Schema& object, const void* defaults, Way way) const override {
    if (way == Way::in) part_->describe_any(object, defaults, way);
  }
};

class LaterPart final : public AroundPart {
 public:
  using AroundPart::AroundPart;
  void describe_any(Schema& object, const void* defaults, Way way) const override {
    const Schema required = object.value("required", Schema::array());
    part_->describe_any(object, defaults, way);
    object.erase("required");
    if (!required.empty()) object["required"] = required;
  }
};

}  // namespace

AnyPartPtr member_part(MemberText text, const AnyFormatPtr& format, const Access& access) {
  return AnyPartPtr(new MemberPart(std::move(text), format, access));
}

AnyPartPtr member_part(Need need, std::string_view key, std::string_view text,
                       const AnyFormatPtr& format, const Access& access) {
  return member_part({std::string(key), std::string(text), need, {}}, format, access);
}

AnyPartPtr member_part(Need need, std::string_view key, std::string_view text,
                       const AnyFormatPtr& format, std::ptrdiff_t offset) {
  return member_part(need, key, text, format, Access(offset));
}

AnyPartPtr output_part(Need need, std::string_view key, std::string_view text,
                       const AnyFormatPtr& format, const Access& access) {
  return AnyPartPtr(
      new OutputPart({std::string(key), std::string(text), need, {}}, format, access));
}

AnyPartPtr output_part(Need need, std::string_view key, std::string_view text,
                       const AnyFormatPtr& format, std::ptrdiff_t offset) {
  return output_part(need, key, text, format, Access(offset));
}

AnyPartPtr constant_part(std::string_view key, const Schema& value) {
  return AnyPartPtr(new ConstantPart(key, value));
}

AnyPartPtr output_times(std::string_view what, std::ptrdiff_t offset, bool may_lack,
                        std::string_view text) {
  return AnyPartPtr(new ToldTimes(what, offset, may_lack, text));
}

AnyPartPtr read_only(const AnyPartPtr& part) { return AnyPartPtr(new ReadOnlyPart(part)); }

AnyPartPtr later(const AnyPartPtr& part) { return AnyPartPtr(new LaterPart(part)); }

void describe_member(Schema& object, const MemberText& member, Schema schema,
                     const std::optional<Schema>& fallback, Way way) {
  if (!member.text.empty()) schema["description"] = member.text;
  const bool always_told = way == Way::out && fallback;
  if (member.need == Need::required || always_told) {
    object["required"].push_back(member.key);
  } else if (way == Way::out) {
    // Optional in output.
  } else if (member.stated) {
    schema["default"] = *member.stated;
  } else if (fallback && is_telling(*fallback)) {
    schema["default"] = *fallback;
  }
  object["properties"][member.key] = std::move(schema);
}

}  // namespace armloom::formats
