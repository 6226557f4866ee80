#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "server/codec/json_node.h"
#include "server/codec/json_writer.h"

namespace armloom {

// JSON Schema (draft 2020-12); keys keep their order.
using Schema = nlohmann::ordered_json;

// Direction for which a schema is made: input from clients, or output of the server. In output,
// members with defaults are always present.
enum class Way { in, out };

using PathMap = std::function<std::string(const std::string&)>;

// Describes the JSON form of a value. Its reader, writer, schema and reference are made from this
// description. Immutable, and shared by threads.
//
// The type of the value is erased, so that formats are compiled only once: `out` and `value` are
// addresses of the value. FormatPtr<T> is the typed handle.
class AnyFormat {
 public:
  AnyFormat() = default;
  AnyFormat(const AnyFormat&) = delete;
  AnyFormat& operator=(const AnyFormat&) = delete;
  virtual ~AnyFormat() = default;
  // Reads into `out`, which must hold the defaults. Adds faults to the list of the node; if there
  // are faults, the caller must not use `out`.
  virtual void read_any(const JsonNode& node, void* out) const = 0;
  virtual void write_any(JsonWriter& out, const void* value) const = 0;
  [[nodiscard]] virtual Schema schema(Way way) const = 0;
  // Replaces the file paths in a JSON value that has not been read yet. Ignores everything that
  // does not fit the format.
  virtual void map_paths(nlohmann::json& /*value*/, const PathMap& /*map*/) const {}
};

// A std::shared_ptr whose copying and destruction are not inlined, because descriptions create
// thousands of temporaries.
template <class Any>
class SharedAny {
 public:
  explicit SharedAny(const Any* made);  // takes ownership
  SharedAny(const SharedAny& other);
  SharedAny(SharedAny&& other) noexcept;
  SharedAny& operator=(SharedAny other) noexcept;
  ~SharedAny();
  const Any* operator->() const { return any_.get(); }
  const Any& operator*() const { return *any_; }

 private:
  std::shared_ptr<const Any> any_;
};
using AnyFormatPtr = SharedAny<AnyFormat>;

// A typed AnyFormat. To keep a Format, copy it: a reference from `*format_pointer` is valid only as
// long as that FormatPtr.
template <class T>
class Format {
 public:
  // Precondition: `any` was made for T.
  explicit Format(AnyFormatPtr any) : any_(std::move(any)) {}
  void read(const JsonNode& node, T& out) const { any_->read_any(node, &out); }
  void write(JsonWriter& out, const T& value) const { any_->write_any(out, &value); }
  [[nodiscard]] Schema schema(Way way) const { return any_->schema(way); }
  void map_paths(nlohmann::json& value, const PathMap& map) const { any_->map_paths(value, map); }
  [[nodiscard]] const AnyFormatPtr& any() const { return any_; }

 private:
  AnyFormatPtr any_;
};

template <class T>
class FormatPtr {
 public:
  explicit FormatPtr(AnyFormatPtr any) : format_(std::move(any)) {}
  const Format<T>* operator->() const { return &format_; }
  const Format<T>& operator*() const { return format_; }

 private:
  Format<T> format_;
};

// Base class of handwritten formats.
template <class T>
class CustomFormat : public AnyFormat {
 public:
  using Value = T;
  virtual void read(const JsonNode& node, T& out) const = 0;
  virtual void write(JsonWriter& out, const T& value) const = 0;
  void read_any(const JsonNode& node, void* out) const final { read(node, *static_cast<T*>(out)); }
  void write_any(JsonWriter& out, const void* value) const final {
    write(out, *static_cast<const T*>(value));
  }
};

template <class Kind, class... Arguments>
[[nodiscard]] FormatPtr<typename Kind::Value> make_format(Arguments&&... arguments) {
  return FormatPtr<typename Kind::Value>(
      AnyFormatPtr(new Kind(std::forward<Arguments>(arguments)...)));
}

// Return a value for a schema. Whole numbers get no decimal point.
[[nodiscard]] Schema as_json(double number);
[[nodiscard]] Schema as_json(const JsonWriter& written);
[[nodiscard]] Schema as_json(const AnyFormat& format, const void* value);

}  // namespace armloom
