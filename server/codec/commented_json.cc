#include "server/codec/commented_json.h"

#include <set>
#include <sstream>
#include <string_view>

#include "server/codec/json_pointer.h"

namespace armloom {
namespace {

constexpr std::size_t kColumns = 100;

std::string on_one_line(const Schema& value) {
  if (!value.is_structured()) return value.dump();
  std::string text(1, value.is_array() ? '[' : '{');
  for (const auto& [key, member] : value.items()) {
    if (text.size() > 1) text += ", ";
    if (value.is_object()) text += Schema(key).dump() + ": ";
    text += on_one_line(member);
  }
  return text + (value.is_array() ? ']' : '}');
}

class CommentedWriter {
 public:
  explicit CommentedWriter(const JsonNotes& notes) : notes_(notes) {}

  void write(const Schema& value, const Schema* schema, const std::string& pointer) {
    const std::string line = on_one_line(value);
    const bool fits = column() + line.size() + 1 <= kColumns;
    if (value.empty() || !value.is_structured() || (fits && !has_comment(value, schema, pointer))) {
      out_ += line;
      return;
    }
    if (value.is_array()) {
      write_array(value, schema, pointer);
    } else {
      write_object(value, schema, pointer);
    }
  }
  std::string take() { return std::move(out_); }

 private:
  static const Schema* below(const Schema* schema, const std::string& key) {
    if (schema == nullptr) return nullptr;
    const auto properties = schema->find("properties");
    if (properties != schema->end() && properties->contains(key)) return &(*properties)[key];
    const auto others = schema->find("additionalProperties");
    return others != schema->end() && others->is_object() ? &*others : nullptr;
  }
  static const Schema* element(const Schema* schema) {
    if (schema == nullptr || !schema->contains("items")) return nullptr;
    return &(*schema)["items"];
  }

  // Returns true if a member would get a comment.
  bool has_comment(const Schema& value, const Schema* schema, const std::string& pointer) const {
    for (const auto& [key, member] : value.items()) {
      std::string place = pointer;
      append_key(place, key);
      const Schema* inner = value.is_array() ? element(schema) : below(schema, key);
      const bool described = value.is_object() && inner != nullptr &&
                             inner->contains("description") && !described_.contains(inner);
      if (described || notes_.contains(place)) return true;
      if (member.is_structured() && has_comment(member, inner, place)) return true;
    }
    return false;
  }

  void write_object(const Schema& value, const Schema* schema, const std::string& pointer) {
    out_ += "{";
    ++depth_;
    if (pointer.empty()) write_notes("");
    bool first = true;
    for (const auto& [key, member] : value.items()) {
      if (!first) out_ += ",";
      std::string place = pointer;
      append_key(place, key);
      const Schema* inner = below(schema, key);
      if (pointer.empty() && !first) out_ += '\n';  // an empty line between sections
      first = false;
      if (inner != nullptr && described_.insert(inner).second && inner->contains("description")) {
        write_comment((*inner)["description"]);
      }
      write_notes(place);
      new_line();
      out_ += Schema(key).dump() + ": ";
      write(member, inner, place);
    }
    --depth_;
    new_line();
    out_ += "}";
  }

  void write_array(const Schema& value, const Schema* schema, const std::string& pointer) {
    out_ += "[";
    ++depth_;
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (i > 0) out_ += ",";
      std::string place = pointer;
      append_index(place, i);
      write_notes(place);
      new_line();
      write(value[i], element(schema), place);
    }
    --depth_;
    new_line();
    out_ += "]";
  }

  void write_notes(const std::string& place) {
    const auto notes = notes_.find(place);
    if (notes == notes_.end()) return;
    for (const std::string& note : notes->second) write_comment(note);
  }

  // Writes a comment. Line ends become spaces, because text after a line end would not belong to
  // the comment.
  void write_comment(const std::string& text) {
    std::istringstream words(text);
    std::string word;
    std::string line;
    const auto flush = [&] {
      if (line.empty()) return;
      new_line();
      out_ += "//" + line;
      line.clear();
    };
    while (words >> word) {
      if (!line.empty() && 2 * depth_ + 2 + line.size() + 1 + word.size() > kColumns) flush();
      line += " " + word;
    }
    flush();
  }

  void new_line() { out_ += "\n" + std::string(2 * depth_, ' '); }
  std::size_t column() const {
    const std::size_t line = out_.rfind('\n');
    return line == out_.npos ? out_.size() : out_.size() - line - 1;
  }

  const JsonNotes& notes_;
  std::string out_;
  std::size_t depth_ = 0;
  std::set<const Schema*> described_;
};

}  // namespace

std::string commented_json(const Schema& value, const Schema& schema, const JsonNotes& notes) {
  CommentedWriter writer(notes);
  writer.write(value, &schema, "");
  return writer.take() + "\n";
}

}  // namespace armloom
