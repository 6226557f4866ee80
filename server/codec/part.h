#pragma once

#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include "server/codec/format.h"

namespace armloom::formats {

// A part of an object: one member, several members that form a value, or a rule about members. The
// type of the object is erased as in AnyFormat.
class AnyPart {
 public:
  AnyPart() = default;
  AnyPart(const AnyPart&) = delete;
  AnyPart& operator=(const AnyPart&) = delete;
  virtual ~AnyPart() = default;
  virtual void list_keys(std::vector<std::string_view>& /*keys*/) const {}
  // Lists keys that read_any() always refuses with a fault of their own.
  virtual void list_refused_keys(std::vector<std::string_view>& /*keys*/) const {}
  virtual void read_any(const JsonNode& object, void* out) const = 0;
  virtual void write_any(JsonWriter& /*out*/, const void* /*value*/) const {}
  // Adds the members of this part to "properties" and "required" of the object's schema.
  virtual void describe_any(Schema& object, const void* defaults, Way way) const = 0;
  virtual void map_paths(nlohmann::json& /*object*/, const PathMap& /*map*/) const {}
};
using AnyPartPtr = SharedAny<AnyPart>;

template <class T>
class PartPtr {
 public:
  // Precondition: `any` was made for T.
  explicit PartPtr(AnyPartPtr any) : any_(std::move(any)) {}
  void write(JsonWriter& out, const T& value) const { any_->write_any(out, &value); }
  [[nodiscard]] const AnyPartPtr& any() const { return any_; }

 private:
  AnyPartPtr any_;
};

// Base class of handwritten parts.
template <class T>
class CustomPart : public AnyPart {
 public:
  using Value = T;
  virtual void read(const JsonNode& object, T& out) const = 0;
  virtual void describe(Schema& object, const T& defaults, Way way) const = 0;
  void read_any(const JsonNode& object, void* out) const final {
    read(object, *static_cast<T*>(out));
  }
  void describe_any(Schema& object, const void* defaults, Way way) const final {
    describe(object, *static_cast<const T*>(defaults), way);
  }
};

template <class Kind, class... Arguments>
[[nodiscard]] PartPtr<typename Kind::Value> make_part(Arguments&&... arguments) {
  return PartPtr<typename Kind::Value>(AnyPartPtr(new Kind(std::forward<Arguments>(arguments)...)));
}

using AnyParts = std::vector<AnyPartPtr>;
void add_part(AnyParts& parts, const AnyPartPtr& part);

template <class T>
class PartList {
 public:
  PartList() = default;
  PartList(std::initializer_list<PartPtr<T>> parts) { add(parts); }
  void add(std::initializer_list<PartPtr<T>> parts) {
    for (const PartPtr<T>& part : parts) add_part(parts_, part.any());
  }
  [[nodiscard]] const AnyParts& any() const { return parts_; }

 private:
  AnyParts parts_;
};

}  // namespace armloom::formats
