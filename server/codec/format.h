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

// What of a format does not depend on what it is of.
class Described {
 public:
  virtual ~Described() = default;
  [[nodiscard]] virtual Schema schema(Way way) const = 0;
  // Replaces the paths in a JSON value that is to be read as this format. What does not fit the
  // format stays as it is: the reader will say so.
  virtual void map_paths(nlohmann::json& value, const PathMap& map) const {
    static_cast<void>(value);
    static_cast<void>(map);
  }
};

// How a T stands in JSON. One description makes its reader, its writer, its schema, and from the
// schema the reference for people, so that nothing is spelt twice. Formats are values: small ones
// (scalar_formats.h) are put together to lists, objects (object_format.h) and whole files
// (cell_format.h). Immutable, and shared by threads.
template <class T>
class Format : public Described {
 public:
  using Base = Format;
  // Into `out`, which holds the defaults. Faults go to the node's list, with place and value; then
  // `out` is of no use.
  virtual void read(const JsonNode& node, T& out) const = 0;
  virtual void write(JsonWriter& out, const T& value) const = 0;
};

template <class T>
using FormatPtr = std::shared_ptr<const Format<T>>;

// A Kind of format, or of part of one, owned as its Base: what a smart pointer needs is compiled
// once for each Base, not for each of hundreds of kinds.
template <class Kind, class... Arguments>
[[nodiscard]] std::shared_ptr<const typename Kind::Base> make_as_base(Arguments&&... arguments) {
  const typename Kind::Base* made = new Kind(std::forward<Arguments>(arguments)...);
  return std::shared_ptr<const typename Kind::Base>(made);
}

// A value as a schema shows it: a default, a bound. Whole numbers stand without a point.
[[nodiscard]] Schema as_json(double number);
[[nodiscard]] Schema as_json(const JsonWriter& written);
template <class T>
[[nodiscard]] Schema as_json(const Format<T>& format, const T& value) {
  JsonWriter out;
  format.write(out, value);
  return as_json(out);
}

}  // namespace armloom
