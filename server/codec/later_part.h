#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "server/codec/member_part.h"

namespace armloom::formats {

// Members that came later: this version tells them always, but what older ones stored and recorded
// lacks them and is read, too.
template <class T>
class LaterPart final : public Part<T> {
 public:
  explicit LaterPart(PartPtr<T> part) : part_(std::move(part)) {}
  void list_keys(std::vector<std::string_view>& keys) const override { part_->list_keys(keys); }
  void read(const JsonNode& object, T& out) const override { part_->read(object, out); }
  void write(JsonWriter& out, const T& value) const override { part_->write(out, value); }
  void describe(Schema& object, const T& defaults, Way way) const override {
    const Schema required = object.value("required", Schema::array());
    part_->describe(object, defaults, way);
    object.erase("required");
    if (!required.empty()) object["required"] = required;
  }

 private:
  PartPtr<T> part_;
};
template <class T>
[[nodiscard]] PartPtr<T> later(PartPtr<T> part) {
  return make_as_base<LaterPart<T>>(std::move(part));
}

}  // namespace armloom::formats
