#pragma once

#include <cstdint>
#include <optional>

#include "core/coordination/verdict.h"

namespace armloom {

// If a check runs out of its budget of evaluations, the job is not deferred. Its question is
// checked again with a larger budget, up to kEffortMax times the usual budget. Each check continues
// where the previous check ended (motion_store.h).
inline constexpr std::uint64_t kEffortGrowth = 4;
inline constexpr std::uint64_t kEffortMax = 16;

// Returns the next Question::effort, or nullopt if the verdict is final.
[[nodiscard]] inline std::optional<std::uint64_t> larger_effort(const Verdict& verdict,
                                                                std::uint64_t effort) {
  if (!verdict.exhausted || effort >= kEffortMax) return std::nullopt;
  return effort * kEffortGrowth;
}

}  // namespace armloom
