#pragma once

#include <string>
#include <utility>

#include "core/base/problem.h"

namespace armloom {

// What was found in a part of the input joins the other problems: their pointers begin at that
// part, which is at `place`.
inline void add_below(const std::string& place, Problems found, Problems& problems) {
  for (Problem& problem : found) {
    problem.pointer.insert(0, place);
    problems.push_back(std::move(problem));
  }
}

}  // namespace armloom
