#pragma once

#include <string>
#include <string_view>

#include "core/base/problem.h"

namespace armloom {

// The HTTP status of a kind of problem.
[[nodiscard]] int status_of(ProblemKind kind);

// An RFC 9457 problem document. Several problems: the first one at the top, all under "errors".
// Precondition: not empty.
[[nodiscard]] std::string problem_json(const Problems& problems);

// The same for people, one sentence: "config/x.json:/robots/0/urdf: ...". A pointer that is no JSON
// pointer ("panda.urdf: joint panda_joint3") names its own file.
[[nodiscard]] std::string problem_sentence(std::string_view file, const Problem& problem);

}  // namespace armloom
