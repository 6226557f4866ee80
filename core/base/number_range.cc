#include "core/base/number_range.h"

#include <cmath>

#include "core/base/diagnostics.h"

namespace armloom {

std::string in_words(const NumberRange& range) {
  std::string least = std::isfinite(range.lowest)
                          ? (range.open ? "greater than " : "at least ") + text_of(range.lowest)
                          : "";
  if (!std::isfinite(range.highest)) return least;
  const std::string most = (range.open_above ? "less than " : "at most ") + text_of(range.highest);
  return least.empty() ? most : least + " and " + most;
}

}  // namespace armloom
