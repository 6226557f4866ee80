#include "server/codec/schema_names.h"

#include <stdexcept>
#include <utility>

namespace armloom {

Schema refer_to_names(const Schema& schema, const std::string& place, Schema& parts) {
  if (!schema.is_structured()) return schema;
  if (schema.is_array()) {
    Schema list = Schema::array();
    for (const Schema& element : schema) list.push_back(refer_to_names(element, place, parts));
    return list;
  }
  Schema out = Schema::object();
  for (const auto& [key, value] : schema.items()) {
    if (key == "$name") {
      out["$ref"] = place + value.get<std::string>();
    } else if (key == "$of") {
      const std::string name = schema["$name"];
      Schema part = refer_to_names(value, place, parts);
      if (parts.contains(name) && parts[name] != part) {
        throw std::logic_error("two schemas are named " + name);
      }
      parts[name] = std::move(part);
    } else {
      out[key] = refer_to_names(value, place, parts);
    }
  }
  return out;
}

}  // namespace armloom
