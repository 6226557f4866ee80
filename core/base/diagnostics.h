#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "core/base/problem.h"

namespace armloom {

// Collects the problems and warnings of a cell, so that a user sees every mistake at once. Repeated
// entries are skipped, because two robots may share one URDF file. After kMaxDiagnostics entries
// with the same slug, further ones are only counted, so that many of one kind never displace
// another kind. A last entry gives the number of the counted ones.
class Diagnostics {
 public:
  static constexpr std::size_t kMaxDiagnostics = 100;

  void add(Problem problem);
  // Adds a warning: input that is accepted but probably a mistake, or ignored.
  void warn(Problem problem);
  void merge(Diagnostics other);
  void merge_as_warnings(Diagnostics other);

  // Adds a problem of the cell file: `pointer` is a JSON pointer, `detail` a complete sentence.
  void in_cell(std::string slug, std::string pointer, std::string detail,
               decltype(Problem::value) value = {});

  // Returns the number of add() calls, repeated problems included. If this number is the same
  // before and after reading something, no problem was found in it.
  [[nodiscard]] std::size_t count() const { return added_; }

  [[nodiscard]] Problems take();
  [[nodiscard]] Problems take_warnings();

 private:
  struct Kept {
    Problems problems;
    std::set<std::pair<std::string, std::string>> seen;  // pointer, detail
    std::map<std::string, std::size_t> of_slug;
    std::size_t dropped = 0;

    void add(Problem problem);
    [[nodiscard]] Problems take(const std::string& kind);
  };

  Kept problems_;
  Kept warnings_;
  std::size_t added_ = 0;
};

// Returns the shortest text that reads back as the same number: 0.1, not 0.10000000000000001.
[[nodiscard]] std::string text_of(double number);

// Returns a name as one token of a JSON pointer (RFC 6901), with ~ and / escaped.
[[nodiscard]] std::string pointer_token(std::string name);

}  // namespace armloom
