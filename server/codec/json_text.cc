#include "server/codec/json_text.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "server/codec/json_pointer.h"

namespace armloom {
namespace {

using nlohmann::json;

// Builds the JSON value while its text is parsed. Keeps the path to the present place.
class StrictBuilder {
 public:
  explicit StrictBuilder(std::string_view text) : text_(text) {}

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(std::int64_t value) { return put(value); }
  bool number_unsigned(std::uint64_t value) { return put(value); }
  bool number_float(double value, const std::string&) { return put(value); }
  bool string(std::string& value) { return count_part() && put(std::move(value)); }
  bool binary(json::binary_t&) { return false; }  // not in JSON text

  bool start_object(std::size_t) { return open(json::object()); }
  bool start_array(std::size_t) { return open(json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    if (!count_part()) return false;
    Level& level = levels_.back();
    if (level.value->size() >= kJsonMembersMax) {
      return refuse_size("too-many-members",
                         "an object with more than " + std::to_string(kJsonMembersMax) + " members",
                         name);
    }
    const auto [place, is_new] = level.value->emplace(name, nullptr);
    level.key = name;
    level.slot = &*place;
    if (!is_new)
      return refuse("duplicate-key", "the key \"" + name + "\" occurs twice: remove one of the two",
                    name);
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const json::exception& error) {
    // The library gives the number of characters read so far, the wrong one included.
    const std::size_t offset = std::min(position > 0 ? position - 1 : 0, text_.size());
    const bool out_of_range = error.id == 406;
    const std::string found = token_around(offset);
    std::string detail = out_of_range
                             ? "the number exceeds the range of a double: give a smaller one"
                         : found.empty() ? "the text ends before the JSON value is complete"
                                         : "this is not JSON" + remedy_for(found);
    return refuse("malformed-json", where(offset) + ": " + detail, found);
  }

  [[nodiscard]] std::string remedy_for(const std::string& found) const {
    for (const char* number : {"NaN", "nan", "Infinity", "inf"}) {
      if (found.find(number) == std::string::npos) continue;
      return ", which has no " + found + ": give a finite number, or leave the field out";
    }
    const std::size_t first = text_.find_first_not_of(" \t\r\n");
    const bool has_bracket = first != std::string_view::npos && std::strchr("{[", text_[first]);
    return has_bracket
               ? ": look for a quote, comma or bracket that is missing or too many, here or before"
               : "";
  }
  [[nodiscard]] json take() { return std::move(root_); }
  [[nodiscard]] Problem problem() const { return problem_; }

  // Returns "line 3, column 14": counted from one, columns in bytes.
  [[nodiscard]] std::string where(std::size_t offset) const {
    const std::string_view before = text_.substr(0, offset);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t begin = before.rfind('\n') + 1;  // npos + 1 is zero
    return "line " + std::to_string(line) + ", column " + std::to_string(offset - begin + 1);
  }

 private:
  struct Level {
    json* value;
    std::string key;       // key of the member being read
    json* slot = nullptr;  // place for its value
  };

  bool put(json value) {
    if (levels_.empty()) {
      root_ = std::move(value);
    } else if (levels_.back().value->is_array()) {
      if (is_full(*levels_.back().value)) return refuse_more();
      levels_.back().value->push_back(std::move(value));
    } else {
      *levels_.back().slot = std::move(value);
    }
    return true;
  }

  bool open(json container) {
    if (levels_.size() >= kJsonDepthMax) {
      return refuse_size("nesting-too-deep",
                         "nested more than " + std::to_string(kJsonDepthMax) +
                             " levels deep: look for brackets that are not closed");
    }
    if (!count_part()) return false;
    json* place = &root_;
    if (levels_.empty()) {
      root_ = std::move(container);
    } else if (Level& parent = levels_.back(); parent.value->is_array()) {
      if (is_full(*parent.value)) return refuse_more();
      parent.value->push_back(std::move(container));
      place = &parent.value->back();
    } else {
      *parent.slot = std::move(container);
      place = parent.slot;
    }
    // `place` stays valid, because nothing is added to the parent before this container is closed.
    levels_.push_back(Level{place, {}, nullptr});
    return true;
  }

  bool count_part() {
    if (++parts_ <= kJsonPartsMax) return true;
    return refuse_size("too-many-parts", "a text of more than " + std::to_string(kJsonPartsMax) +
                                             " arrays, objects, members and strings");
  }

  static bool is_full(const json& array) { return array.size() >= kJsonElementsMax; }
  bool refuse_more() {
    return refuse_size("too-many-elements",
                       "an array with more than " + std::to_string(kJsonElementsMax) + " elements");
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  bool refuse_size(std::string slug, std::string detail, std::string found = "") {
    problem_.kind = ProblemKind::too_large;
    return refuse(std::move(slug), std::move(detail), std::move(found));
  }

  bool refuse(std::string slug, std::string detail, std::string found) {
    if (!problem_.slug.empty()) return false;
    problem_.slug = std::move(slug);
    problem_.detail = std::move(detail);
    if (!found.empty()) problem_.value = std::move(found);
    for (const Level& level : levels_) {
      if (level.value->is_array()) {  // an element that is being read is already in its array
        const bool innermost = &level == &levels_.back();
        append_index(problem_.pointer, level.value->size() - (innermost ? 0 : 1));
      } else if (level.slot != nullptr) {
        append_key(problem_.pointer, level.key);
      }
    }
    return false;
  }

  // Returns the token at `offset`, for the message.
  [[nodiscard]] std::string token_around(std::size_t offset) const {
    static constexpr std::string_view kDelimiters = " \t\r\n,:[]{}";
    static constexpr std::size_t kShown = 40;
    if (offset >= text_.size()) return "";
    std::size_t begin = offset;
    while (begin > 0 && offset - begin < kShown &&
           kDelimiters.find(text_[begin - 1]) == kDelimiters.npos)
      --begin;
    if (kDelimiters.find(text_[offset]) != kDelimiters.npos && begin < offset) {
      return std::string(text_.substr(begin, offset - begin));
    }
    std::size_t end = offset + 1;
    while (end < text_.size() && end - begin < kShown &&
           kDelimiters.find(text_[end]) == kDelimiters.npos)
      ++end;
    return std::string(text_.substr(begin, end - begin));
  }

  std::string_view text_;
  json root_;
  std::vector<Level> levels_;
  std::size_t parts_ = 0;
  Problem problem_{ProblemKind::malformed, "", "", "", {}};
};

}  // namespace

Result<nlohmann::json> parse_json(std::string_view text, JsonComments comments) {
  StrictBuilder builder(text);
  if (const std::size_t nul = text.find('\0'); nul != text.npos) {
    return failure(Problem{ProblemKind::malformed, "malformed-json", "",
                           builder.where(nul) + ": the text contains a NUL byte", "\\u0000"});
  }
  const bool ignore_comments = comments == JsonComments::allowed;
  if (!json::sax_parse(text.begin(), text.end(), &builder, json::input_format_t::json, true,
                       ignore_comments)) {
    return failure(builder.problem());
  }
  return builder.take();
}

}  // namespace armloom
