#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "server/codec/json_node.h"
#include "server/codec/json_writer.h"

namespace armloom {

// JSON Schema (draft 2020-12); keys keep the order in which they are described.
using Schema = nlohmann::ordered_json;

// Whose JSON a schema describes: what may come in, or what the server says. What is said has every
// member that a default would stand for.
enum class Way { in, out };

// What becomes of each path in a text.
using PathMap = std::function<std::string(const std::string&)>;

// Describes the JSON of a value. One description makes the reader, the writer, the schema and, from
// the schema, the reference for people. Small formats (scalar_formats.h) are combined to lists,
// objects (object_format.h) and whole files (cell_format.h). Immutable, and shared by threads.
//
// The type of the value is erased, so that formats are compiled once instead of once for each T:
// `out` and `value` are addresses. FormatPtr<T> below is the typed handle, with which the compiler
// checks the types in the description of a message.
class AnyFormat {
 public:
  AnyFormat() = default;
  AnyFormat(const AnyFormat&) = delete;
  AnyFormat& operator=(const AnyFormat&) = delete;
  virtual ~AnyFormat() = default;
  // Reads into `out`, which holds the defaults. Faults go to the node's list, with place and value;
  // `out` must not be used then.
  virtual void read_any(const JsonNode& node, void* out) const = 0;
  virtual void write_any(JsonWriter& out, const void* value) const = 0;
  [[nodiscard]] virtual Schema schema(Way way) const = 0;
  // Replaces the paths in a JSON value that is to be read as this format. What does not fit the
  // format stays as it is: the reader will say so.
  virtual void map_paths(nlohmann::json& /*value*/, const PathMap& /*map*/) const {}
};

// A std::shared_ptr that is copied and destroyed by functions in format.cc instead of inline:
// descriptions of messages make thousands of temporary ones.
template <class Any>
class SharedAny {
 public:
  explicit SharedAny(const Any* made);  // owns it
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

// An AnyFormat of values of type T. To keep it, copy it: a reference from `*format_pointer` is
// valid only as long as the FormatPtr.
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

// The base class of formats that are written by hand for a T.
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

// Kind: a CustomFormat.
template <class Kind, class... Arguments>
[[nodiscard]] FormatPtr<typename Kind::Value> make_format(Arguments&&... arguments) {
  return FormatPtr<typename Kind::Value>(
      AnyFormatPtr(new Kind(std::forward<Arguments>(arguments)...)));
}

// A value as a schema shows it: a default, a bound. Whole numbers stand without a point.
[[nodiscard]] Schema as_json(double number);
[[nodiscard]] Schema as_json(const JsonWriter& written);
[[nodiscard]] Schema as_json(const AnyFormat& format, const void* value);

}  // namespace armloom
