#pragma once

#include <limits>
#include <string>

namespace armloom {

// Range of allowed numbers from `lowest` to `highest`. An open end is excluded. NaN is never
// inside.
struct NumberRange {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool open = false;        // excludes `lowest`
  const char* remedy = "";  // appended to the error message: "; degrees go to rpy_deg"
  bool open_above = false;  // excludes `highest`

  [[nodiscard]] constexpr bool holds(double number) const {
    return (open ? number > lowest : number >= lowest) &&
           (open_above ? number < highest : number <= highest);
  }
};

// Describes the range: "greater than 0 and at most 1". Precondition: one end is finite.
[[nodiscard]] std::string in_words(const NumberRange& range);

}  // namespace armloom
