#pragma once

#include <string>
#include <utility>

#include "core/base/problem.h"

namespace armloom {

// Appends the problems found in the part of the input at `place`, a prefix of their pointers.
inline void add_below(const std::string& place, Problems found, Problems& problems) {
  for (Problem& problem : found) {
    problem.pointer.insert(0, place);
    problems.push_back(std::move(problem));
  }
}

}  // namespace armloom
