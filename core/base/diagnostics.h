#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "core/base/problem.h"

namespace armloom {

// Collects what is wrong with a cell, and what is only odd, while reading goes on, so that a user
// sees every mistake at once. Two robots may share one URDF file: a problem that was already found
// is not repeated. Bounded: after kMaxDiagnostics the rest is only counted, and the last problem
// says how many.
class Diagnostics {
 public:
  static constexpr std::size_t kMaxDiagnostics = 100;

  void add(Problem problem);
  // What can be taken but is hardly meant, or is left out: it refuses nothing. Bounded alike.
  void warn(Problem problem);
  // Takes over what another one has found: its problems, or all of it as warnings.
  void merge(Diagnostics other);
  void merge_as_warnings(Diagnostics other);

  // A mistake in the cell file: `pointer` is a JSON pointer, `detail` a sentence that stands alone.
  void in_cell(std::string slug, std::string pointer, std::string detail,
               decltype(Problem::value) value = {});

  // How often add was called: a reader that finds it unchanged has found nothing wrong itself, even
  // where its problem repeats another's.
  [[nodiscard]] std::size_t count() const { return added_; }

  // Hands over what was found; empty when nothing was.
  [[nodiscard]] Problems take();
  [[nodiscard]] Problems take_warnings();

 private:
  struct Kept {
    Problems problems;
    std::set<std::pair<std::string, std::string>> seen;  // pointer, detail
    std::size_t dropped = 0;

    void add(Problem problem);
    [[nodiscard]] Problems take(const std::string& kind);
  };

  Kept problems_;
  Kept warnings_;
  std::size_t added_ = 0;
};

// The shortest text that reads back as the same number: 0.1, not 0.10000000000000001.
[[nodiscard]] std::string text_of(double number);

// A name as one token of a JSON pointer (RFC 6901): ~ and / are escaped.
[[nodiscard]] std::string pointer_token(std::string name);

}  // namespace armloom
