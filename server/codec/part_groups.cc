#include "server/codec/part_groups.h"

#include "server/codec/object_format.h"

namespace armloom::formats {

void add_part(AnyParts& parts, const AnyPartPtr& part) { parts.push_back(part); }

namespace {

class Parts final : public AnyPart {
 public:
  explicit Parts(AnyParts parts) : parts_(std::move(parts)) {}
  void list_keys(std::vector<std::string_view>& keys) const override {
    for (const auto& part : parts_) part->list_keys(keys);
  }
  void list_refused_keys(std::vector<std::string_view>& keys) const override {
    for (const auto& part : parts_) part->list_refused_keys(keys);
  }
  void read_any(const JsonNode& object, void* out) const override {
    for (const auto& part : parts_) part->read_any(object, out);
  }
  void write_any(JsonWriter& out, const void* value) const override {
    for (const auto& part : parts_) part->write_any(out, value);
  }
  void describe_any(Schema& object, const void* defaults, Way way) const override {
    for (const auto& part : parts_) part->describe_any(object, defaults, way);
  }
  void map_paths(nlohmann::json& object, const PathMap& map) const override {
    for (const auto& part : parts_) part->map_paths(object, map);
  }

 private:
  AnyParts parts_;
};

class InlinePart final : public AroundPart {
 public:
  InlinePart(std::ptrdiff_t offset, const AnyPartPtr& part) : AroundPart(part), offset_(offset) {}
  void read_any(const JsonNode& object, void* out) const override {
    part_->read_any(object, address_at(out, offset_));
  }
  void write_any(JsonWriter& out, const void* value) const override {
    part_->write_any(out, address_at(value, offset_));
  }
  void describe_any(Schema& object, const void* defaults, Way way) const override {
    part_->describe_any(object, address_at(defaults, offset_), way);
  }

 private:
  std::ptrdiff_t offset_;
};

class ObjectFormat final : public AnyFormat {
 public:
  ObjectFormat(AnyParts parts, WithDefaults with_defaults)
      : parts_(std::move(parts)), with_defaults_(with_defaults) {
    parts_.list_keys(keys_);
    parts_.list_refused_keys(refused_);
  }
  void read_any(const JsonNode& node, void* out) const override {
    if (node.object(keys_, refused_)) parts_.read_any(node, out);
  }
  void write_any(JsonWriter& out, const void* value) const override {
    out.begin_object();
    parts_.write_any(out, value);
    out.end_object();
  }
  Schema schema(Way way) const override {
    Schema object{{"type", "object"}, {"additionalProperties", false}};
    object["properties"] = Schema::object();
    const auto describe = [&](const void* defaults) { parts_.describe_any(object, defaults, way); };
    with_defaults_(describe);
    return object;
  }
  void map_paths(nlohmann::json& value, const PathMap& map) const override {
    if (value.is_object()) parts_.map_paths(value, map);
  }

 private:
  Parts parts_;
  WithDefaults with_defaults_;
  std::vector<std::string_view> keys_;
  std::vector<std::string_view> refused_;
};

}  // namespace

AnyPartPtr parts(AnyParts of_it) { return AnyPartPtr(new Parts(std::move(of_it))); }

AnyPartPtr inlined(std::ptrdiff_t offset, const AnyPartPtr& part) {
  return AnyPartPtr(new InlinePart(offset, part));
}

AnyFormatPtr object_format(AnyParts parts, WithDefaults with_defaults) {
  return AnyFormatPtr(new ObjectFormat(std::move(parts), with_defaults));
}

}  // namespace armloom::formats
