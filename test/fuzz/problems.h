#pragma once

#include <nlohmann/json.hpp>

#include "core/base/problem.h"
#include "server/messages/problem.h"
#include "test/fuzz/fuzz.h"

namespace armloom::fuzz {

// Checks what every refusal must have: at least one problem, a sentence for each problem, and a
// response of valid JSON. The values found in the input may be any bytes.
inline void demand_readable(const Problems& problems) {
  demand(!problems.empty());
  for (const Problem& problem : problems) {
    demand(!problem.slug.empty() && !problem.detail.empty());
    demand(!problem_sentence("file", problem).empty());
  }
  const auto answer = nlohmann::json::parse(problem_json(problems), nullptr, false);
  demand(answer.is_object());
  demand(answer["status"].get<int>() >= 400 && answer["status"].get<int>() < 500);
}

}  // namespace armloom::fuzz
