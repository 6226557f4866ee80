#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

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

// How a T stands in JSON. One description makes its reader, its writer, its schema, and from the
// schema the reference for people, so that nothing is spelt twice. Formats are values: small ones
// (scalar_formats.h) are put together to lists, objects (object_format.h) and whole files
// (cell_format.h). Immutable, and shared by threads.
template <class T>
class Format {
 public:
  virtual ~Format() = default;
  // Into `out`, which holds the defaults. Faults go to the node's list, with place and value; then
  // `out` is of no use.
  virtual void read(const JsonNode& node, T& out) const = 0;
  virtual void write(JsonWriter& out, const T& value) const = 0;
  [[nodiscard]] virtual Schema schema(Way way) const = 0;
  // Replaces the paths in a JSON value that is to be read as this format. What does not fit the
  // format stays as it is: the reader will say so.
  virtual void map_paths(nlohmann::json& value, const PathMap& map) const {
    static_cast<void>(value);
    static_cast<void>(map);
  }
};

template <class T>
using FormatPtr = std::shared_ptr<const Format<T>>;

// A value as a schema shows it: a default, a bound. Whole numbers stand without a point.
template <class T>
[[nodiscard]] Schema as_json(const Format<T>& format, const T& value) {
  JsonWriter out;
  format.write(out, value);
  return Schema::parse(out.text());
}
[[nodiscard]] Schema as_json(double number);

}  // namespace armloom
