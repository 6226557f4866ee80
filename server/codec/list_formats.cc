#include "server/codec/list_formats.h"

#include <utility>

namespace armloom::formats {

bool is_readable(const JsonNode& array, const ListSize& size) {
  const std::size_t found = array.raw().size();
  if (!size.most || found <= *size.most) return true;
  array.fault(ProblemKind::too_large, "too-many-" + size.what,
              std::to_string(found) + " " + size.noun + ", at most " + std::to_string(*size.most) +
                  " are allowed: send fewer, or in parts");
  return false;
}

void check_fewest(const JsonNode& array, const ListSize& size) {
  if (array.raw().size() >= size.fewest) return;
  array.invalid("too-few", "at least " + (size.fewest == 1 ? "one" : std::to_string(size.fewest)) +
                               " is required here, found " + std::to_string(array.raw().size()));
}

namespace {

class ListFormat final : public AnyFormat {
 public:
  ListFormat(const AnyFormatPtr& element, ListSize size, const ListOperations& operations)
      : element_(element), size_(std::move(size)), operations_(operations) {}

  void read_any(const JsonNode& node, void* out) const override {
    operations_.clear(out, 0);
    if (!node.array() || !is_readable(node, size_)) return;
    operations_.clear(out, node.raw().size());
    node.each([&](const JsonNode& n) { element_->read_any(n, operations_.add(out)); });
    check_fewest(node, size_);
  }
  void write_any(JsonWriter& out, const void* list) const override {
    out.begin_array();
    const auto* element = static_cast<const std::byte*>(operations_.data(list));
    for (std::size_t left = operations_.size(list); left > 0; --left) {
      element_->write_any(out, element);
      element += operations_.element_size;
    }
    out.end_array();
  }
  Schema schema(Way way) const override {
    Schema schema{{"type", "array"}, {"items", element_->schema(way)}};
    if (size_.fewest > 0) schema["minItems"] = size_.fewest;
    if (size_.most) schema["maxItems"] = *size_.most;
    return schema;
  }
  void map_paths(nlohmann::json& value, const PathMap& map) const override {
    if (!value.is_array()) return;
    for (auto& element : value) element_->map_paths(element, map);
  }

 private:
  AnyFormatPtr element_;
  ListSize size_;
  const ListOperations& operations_;
};

class DictionaryFormat final : public AnyFormat {
 public:
  DictionaryFormat(const AnyFormatPtr& member, const DictionaryOperations& operations)
      : member_(member), operations_(operations) {}

  void read_any(const JsonNode& node, void* out) const override {
    node.members([&](const std::string& key, const JsonNode& member) {
      member_->read_any(member, operations_.at(out, key));
    });
  }
  void write_any(JsonWriter& out, const void* map) const override {
    out.begin_object();
    operations_.write(out, map, *member_);
    out.end_object();
  }
  Schema schema(Way way) const override {
    return {{"type", "object"}, {"additionalProperties", member_->schema(way)}};
  }
  void map_paths(nlohmann::json& value, const PathMap& map) const override {
    if (!value.is_object()) return;
    for (auto& [key, member] : value.items()) member_->map_paths(member, map);
  }

 private:
  AnyFormatPtr member_;
  const DictionaryOperations& operations_;
};

class PairFormat final : public AnyFormat {
 public:
  PairFormat(const AnyFormatPtr& element, std::ptrdiff_t first, std::ptrdiff_t second)
      : element_(element), first_(first), second_(second) {}

  void read_any(const JsonNode& node, void* out) const override {
    if (!node.array()) return;
    if (node.raw().size() != 2) {
      return node.invalid("wrong-size",
                          "expected an array of 2, found " + std::to_string(node.raw().size()));
    }
    std::ptrdiff_t next = first_;
    node.each([&](const JsonNode& element) {
      element_->read_any(element, address_at(out, next));
      next = second_;
    });
  }
  void write_any(JsonWriter& out, const void* pair) const override {
    out.begin_array();
    element_->write_any(out, address_at(pair, first_));
    element_->write_any(out, address_at(pair, second_));
    out.end_array();
  }
  Schema schema(Way way) const override {
    return {{"type", "array"}, {"items", element_->schema(way)}, {"minItems", 2}, {"maxItems", 2}};
  }

 private:
  AnyFormatPtr element_;
  std::ptrdiff_t first_;
  std::ptrdiff_t second_;
};

}  // namespace

AnyFormatPtr list(const AnyFormatPtr& element, ListSize size, const ListOperations& operations) {
  return AnyFormatPtr(new ListFormat(element, std::move(size), operations));
}

AnyFormatPtr dictionary(const AnyFormatPtr& member, const DictionaryOperations& operations) {
  return AnyFormatPtr(new DictionaryFormat(member, operations));
}

AnyFormatPtr pair_of(const AnyFormatPtr& element, std::ptrdiff_t first, std::ptrdiff_t second) {
  return AnyFormatPtr(new PairFormat(element, first, second));
}

}  // namespace armloom::formats
