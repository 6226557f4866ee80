#include "server/codec/json_node.h"

#include <algorithm>
#include <cmath>

#include "core/base/nearest_name.h"
#include "server/codec/json_pointer.h"

namespace armloom {
namespace {

using nlohmann::json;

// Fields of requests and cell files that version 0.2 renamed: old and new name.
constexpr std::pair<std::string_view, std::string_view> kRenamed[] = {
    {"approach", "move_to_start"}, {"horizon_legs", "horizon_steps"}, {"order", "reorderable"}};

std::optional<std::string_view> renamed(std::string_view key,
                                        std::span<const std::string_view> known) {
  const auto it =
      std::ranges::find(kRenamed, key, &std::pair<std::string_view, std::string_view>::first);
  const bool is_known = it != std::end(kRenamed) && std::ranges::count(known, it->second) > 0;
  return is_known ? std::optional(it->second) : std::nullopt;
}

// Returns the value that was found, shortened so that it fits into a sentence.
std::variant<std::monostate, double, std::string> shown(const json& value) {
  static constexpr std::size_t kShown = 80;
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get_ref<const std::string&>().substr(0, kShown);
  if (value.is_array()) return "array of " + std::to_string(value.size());
  if (value.is_object()) return "object";
  return value.dump();
}

std::string spelled(double number) { return json(number).dump(); }

bool is_whole_double(const json& value) {
  return value.is_number_float() && value.get<double>() == std::trunc(value.get<double>());
}

// Returns nullopt if the number is out of range. Precondition: the value is a whole number.
std::optional<std::int64_t> whole_within_int64(const json& value) {
  constexpr double kBeyond = 9223372036854775808.0;  // 2^63
  if (value.is_number_float()) {
    const auto number = value.get<double>();
    if (number < -kBeyond || number >= kBeyond) return std::nullopt;
    return static_cast<std::int64_t>(number);
  }
  if (value.is_number_unsigned() &&
      value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max()) {
    return std::nullopt;
  }
  return value.get<std::int64_t>();
}

}  // namespace

std::string JsonNode::pointer() const {
  std::string text;
  if (parent_ == nullptr) return std::string(key_);
  text = parent_->pointer();
  if (index_) {
    append_index(text, *index_);
  } else {
    append_key(text, key_);
  }
  return text;
}

void JsonNode::fault(ProblemKind kind, std::string slug, std::string detail) const {
  if (faults_->size() >= kFaultsMax) return;
  faults_->push_back(Problem{kind, std::move(slug), pointer(), std::move(detail), shown(*value_)});
}

bool JsonNode::wrong_type(const char* expected) const {
  fault(ProblemKind::malformed, "wrong-type",
        std::string("expected ") + expected + ", found " + value_->type_name() +
            (value_->is_null() ? ": leave the field out if it has no value" : ""));
  return false;
}

void JsonNode::missing(std::string_view key, const std::string& what) const {
  if (faults_->size() >= kFaultsMax) return;
  std::string place = pointer();
  append_key(place, key);
  faults_->push_back(Problem{
      ProblemKind::invalid,
      "missing-field",
      std::move(place),
      "\"" + std::string(key) + "\" is missing" + (what.empty() ? "" : ": give the " + what),
      {}});
}

bool JsonNode::array() const { return value_->is_array() || wrong_type("an array"); }
bool JsonNode::is_object() const { return value_->is_object() || wrong_type("an object"); }

bool JsonNode::object(std::span<const std::string_view> known,
                      std::span<const std::string_view> refused) const {
  if (!is_object()) return false;
  // A refused key has a better reason than unknown ones.
  if (std::ranges::any_of(refused, [this](std::string_view key) { return has(key); })) return true;
  constexpr std::size_t kListed = 20;
  for (auto it = value_->begin(); it != value_->end(); ++it) {
    const std::string_view key = it.key();
    if (std::ranges::count(known, key) > 0) continue;
    std::string list;
    for (const std::string_view name : known.first(std::min(known.size(), kListed))) {
      list += list.empty() ? "" : ", ";
      list += name;
    }
    if (known.size() > kListed) list += ", ...";
    const auto now = renamed(it.key(), known);
    const auto meant = nearest_name(it.key(), known);
    JsonNode(it.value(), *this, it.key())
        .invalid("unknown-field",
                 "unknown field \"" + it.key() + "\"" +
                     (now     ? ", renamed to \"" + std::string(*now) + "\" in version 0.2;"
                      : meant ? ", did you mean \"" + std::string(*meant) + "\"?"
                              : ";") +
                     " known here: " + list);
  }
  return true;
}

bool JsonNode::read(double& out) const {
  if (!value_->is_number()) return wrong_type("a number");
  out = value_->get<double>();
  return true;
}

bool JsonNode::read(std::string& out) const {
  if (!value_->is_string()) return wrong_type("a string");
  out = value_->get_ref<const std::string&>();
  return true;
}

bool JsonNode::read(bool& out) const {
  if (!value_->is_boolean()) return wrong_type("true or false");
  out = value_->get<bool>();
  return true;
}

bool JsonNode::read_integer(std::int64_t& out, std::int64_t lowest, std::int64_t highest) const {
  const bool is_whole = value_->is_number_integer() || is_whole_double(*value_);
  if (!is_whole) return wrong_type("an integer");
  const auto number = whole_within_int64(*value_);
  if (!number || *number < lowest || *number > highest) {
    invalid("out-of-range", value_->dump() + " is not within " + std::to_string(lowest) + ".." +
                                std::to_string(highest));
    return false;
  }
  out = *number;
  return true;
}

bool JsonNode::read(std::vector<double>& out) const {
  if (!array()) return false;
  const std::size_t faults_before = faults_->size();
  out.clear();
  out.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) {
    const json& element = (*value_)[i];
    if (element.is_number()) {
      out.push_back(element.get<double>());
    } else {
      JsonNode(element, *this, i).wrong_type("a number");
    }
  }
  return faults_->size() == faults_before;
}

bool JsonNode::read(std::vector<std::string>& out) const {
  const std::size_t faults_before = faults_->size();
  out.clear();
  each([&](const JsonNode& element) {
    std::string text;
    if (element.read(text)) out.push_back(std::move(text));
  });
  return faults_->size() == faults_before;
}

bool JsonNode::read_within(double& out, double lowest, double highest) const {
  double number = 0.0;
  if (!read(number)) return false;
  if (!(number >= lowest && number <= highest)) {
    invalid("out-of-range",
            spelled(number) + " is not within " + spelled(lowest) + ".." + spelled(highest));
    return false;
  }
  out = number;
  return true;
}

bool JsonNode::read_numbers(double* out, std::size_t size) const {
  std::vector<double> numbers;
  const std::string expected = "an array of " + std::to_string(size) +
                               (size == 1 ? " number, in brackets" : " numbers, in brackets");
  if (!value_->is_array()) return wrong_type(expected.c_str());
  if (!read(numbers)) return false;
  if (numbers.size() != size) {
    invalid("wrong-size", "expected " + std::to_string(size) + " numbers, found " +
                              std::to_string(numbers.size()));
    return false;
  }
  std::copy(numbers.begin(), numbers.end(), out);
  return true;
}

}  // namespace armloom
