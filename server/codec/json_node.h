#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"

namespace armloom {

// A JSON value with its place in the document. Faults are added to the list of the root, and
// reading continues. A wrong type is `malformed`, an impossible value `invalid`. The value and the
// parent node must outlive the node.
class JsonNode {
 public:
  inline static constexpr std::size_t kFaultsMax = 20;

  // Makes the root of a document. `prefix` precedes every pointer ("/3/job").
  JsonNode(const nlohmann::json& value, std::string_view prefix, Problems& faults)
      : value_(&value), key_(prefix), faults_(&faults) {}

  [[nodiscard]] std::string pointer() const;
  [[nodiscard]] const nlohmann::json& raw() const { return *value_; }

  // Returns true if the value is an object. Reports keys that are neither in `known` nor in
  // `refused`; a fault for the latter is up to the caller.
  [[nodiscard]] bool object(std::span<const std::string_view> known,
                            std::span<const std::string_view> refused = {}) const;
  [[nodiscard]] bool object(std::initializer_list<std::string_view> known) const {
    return object(std::span(known.begin(), known.size()));
  }
  [[nodiscard]] bool has(std::string_view key) const { return value_->contains(key); }
  // Calls read(member) if the object has this key. Precondition: object() returned true.
  template <class Read>
  void optional(std::string_view key, Read read) const {
    if (const auto it = value_->find(key); it != value_->end()) read(JsonNode(*it, *this, key));
  }
  // Does the same as optional(), but reports a missing member. `what`: what to give.
  template <class Read>
  void required(std::string_view key, Read read, const std::string& what = "") const {
    if (const auto it = value_->find(key); it != value_->end()) {
      read(JsonNode(*it, *this, key));
    } else {
      missing(key, what);
    }
  }
  // Calls read(element) for each element of an array. Reports a value that is not an array.
  template <class Read>
  void each(Read read) const {
    if (!array()) return;
    for (std::size_t i = 0; i < value_->size(); ++i) read(JsonNode((*value_)[i], *this, i));
  }
  template <class Read>  // calls read(key, member), ordered by key
  void members(Read read) const {
    if (!is_object()) return;
    for (auto it = value_->begin(); it != value_->end(); ++it) {
      read(it.key(), JsonNode(it.value(), *this, it.key()));
    }
  }

  // On a fault, these return false. `out` is then unchanged, except that a list may be incomplete.
  bool read(double& out) const;
  bool read(std::string& out) const;
  bool read(bool& out) const;
  // Accepts 1.0 and 1e3 as integers, as JSON Schema does.
  bool read_integer(std::int64_t& out, std::int64_t lowest, std::int64_t highest) const;
  bool read(std::vector<double>& out) const;
  bool read(std::vector<std::string>& out) const;
  bool read_within(double& out, double lowest, double highest) const;
  bool read_numbers(double* out, std::size_t size) const;

  [[nodiscard]] bool array() const;
  [[nodiscard]] bool is_object() const;
  void fault(ProblemKind kind, std::string slug, std::string detail) const;
  void invalid(std::string slug, std::string detail) const {
    fault(ProblemKind::invalid, std::move(slug), std::move(detail));
  }

 private:
  JsonNode(const nlohmann::json& value, const JsonNode& parent, std::string_view key)
      : value_(&value), parent_(&parent), key_(key), faults_(parent.faults_) {}
  JsonNode(const nlohmann::json& value, const JsonNode& parent, std::size_t index)
      : value_(&value), parent_(&parent), index_(index), faults_(parent.faults_) {}

  bool wrong_type(const char* expected) const;
  void missing(std::string_view key, const std::string& what) const;

  const nlohmann::json* value_;
  const JsonNode* parent_ = nullptr;
  std::string_view key_;
  std::optional<std::size_t> index_;
  Problems* faults_;
};

}  // namespace armloom
