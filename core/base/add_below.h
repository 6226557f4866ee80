#pragma once

#include <string>
#include <utility>

#include "core/base/problem.h"

namespace armloom {

// Appends problems that were found in a part of the input. `place` is the JSON pointer of this
// part; it is put in front of the problems' pointers.
inline void add_below(const std::string& place, Problems found, Problems& problems) {
  for (Problem& problem : found) {
    problem.pointer.insert(0, place);
    problems.push_back(std::move(problem));
  }
}

}  // namespace armloom
