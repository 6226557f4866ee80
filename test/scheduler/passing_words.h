#pragma once

#include <utility>
#include <vector>

#include "core/precedence/precedence_graph.h"

namespace armloom::test {

inline constexpr StepId kA{JobId{1}}, kB{JobId{2}}, kC{JobId{3}}, kNext{JobId{4}};

inline ConflictRegion region(std::vector<ProgressBox> boxes) {
  using namespace std::chrono_literals;
  return {std::move(boxes), Proximity{.body_a = "a", .body_b = "b", .clearance_m = 0.01}, 1s, 2s};
}

inline CoordinatedMotion motion(StepId step, std::uint32_t arm, Duration duration) {
  return {.step = step, .arms = {ArmId{arm}}, .duration = duration};
}

inline Prediction predicted(const std::vector<CoordinatedMotion>& motions,
                            const std::vector<Dependency>& dependencies) {
  return predict(motions, MotionChains(motions), dependencies);
}

}  // namespace armloom::test
