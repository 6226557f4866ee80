#include "core/model/cell/hazards.h"

#include <algorithm>
#include <array>

namespace armloom {

bool is_hazard(std::string_view slug) {
  static constexpr std::array<std::string_view, 10> kHazards{
      "no-collision",         // links without a shape
      "tiny-mesh",            // almost nothing of the link is checked
      "flat-mesh",            // the shape has no volume
      "other-robot",          // a wrong SRDF disables pairs that can meet
      "moving-base",          // checked as if the base were at rest
      "stationary-joint",     // links are checked at one position only
      "unsupported-joint",    // links are checked at one position only
      "mimic-beyond-limits",  // links may be elsewhere than checked
      "noise-above-error",    // arms leave their certified paths
      "doubtful-setting",     // clearances, errors and delays that cover less than real arms need
  };
  return std::ranges::find(kHazards, slug) != kHazards.end();
}

}  // namespace armloom
