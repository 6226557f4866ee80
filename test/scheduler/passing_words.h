#pragma once

#include <utility>
#include <vector>

#include "core/precedence/precedence_graph.h"

namespace armloom::test {

inline constexpr JobId kA{1}, kB{2}, kC{3}, kNext{4};

inline ConflictRegion region(std::vector<ProgressBox> boxes) {
  using namespace std::chrono_literals;
  return {std::move(boxes), Proximity{.body_a = "a", .body_b = "b", .clearance_m = 0.01}, 1s, 2s};
}

inline CoordinatedMotion motion(JobId job, std::uint32_t arm, Duration duration) {
  return {.job = job, .arms = {ArmId{arm}}, .duration = duration};
}

}  // namespace armloom::test
