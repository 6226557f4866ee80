#pragma once

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "server/codec/member_part.h"
#include "server/codec/member_rules.h"
#include "server/codec/part_groups.h"

namespace armloom::formats {

// Without properties yet.
[[nodiscard]] Schema object_schema();

// A JSON object; keys that no part knows are faults.
template <class T>
class ObjectFormat final : public Format<T> {
 public:
  explicit ObjectFormat(std::vector<PartPtr<T>> parts) : parts_(std::move(parts)) {
    parts_.list_keys(keys_);
  }
  void read(const JsonNode& node, T& out) const override {
    if (node.object(keys_)) parts_.read(node, out);
  }
  void write(JsonWriter& out, const T& value) const override {
    out.begin_object();
    parts_.write(out, value);
    out.end_object();
  }
  Schema schema(Way way) const override {
    Schema object = object_schema();
    parts_.describe(object, T{}, way);
    return object;
  }
  void map_paths(nlohmann::json& value, const PathMap& map) const override {
    if (value.is_object()) parts_.map_paths(value, map);
  }

 private:
  Parts<T> parts_;
  std::vector<std::string_view> keys_;
};

template <class T>
[[nodiscard]] FormatPtr<T> object(std::vector<PartPtr<T>> parts) {
  return make_as_base<ObjectFormat<T>>(std::move(parts));
}

}  // namespace armloom::formats
