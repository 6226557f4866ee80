#pragma once

#include <limits>
#include <string>

namespace armloom {

// Numbers that a value may have: lowest..highest, without the ends that are open. NaN is in none.
struct NumberRange {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool open = false;        // without the lowest itself
  const char* remedy = "";  // told with a number outside: "; degrees go to rpy_deg"
  bool open_above = false;  // without the highest itself

  [[nodiscard]] constexpr bool holds(double number) const {
    return (open ? number > lowest : number >= lowest) &&
           (open_above ? number < highest : number <= highest);
  }
};

// What it takes, in words: "greater than 0 and at most 1". Precondition: one end is finite.
[[nodiscard]] std::string in_words(const NumberRange& range);

}  // namespace armloom
