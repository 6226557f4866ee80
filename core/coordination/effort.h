#pragma once

#include <cstdint>
#include <optional>

#include "core/coordination/verdict.h"

namespace armloom {

// A job is not put off because the budget of evaluations has ended: its question is asked again
// with a larger one, up to kEffortMax times the usual. What has been learnt is kept
// (motion_store.h), so that each asking goes on where the one before it ended.
inline constexpr std::uint64_t kEffortGrowth = 4;
inline constexpr std::uint64_t kEffortMax = 16;

// With what Question::effort to ask again; nothing: that was the last word.
[[nodiscard]] inline std::optional<std::uint64_t> larger_effort(const Verdict& verdict,
                                                                std::uint64_t effort) {
  if (!verdict.exhausted || effort >= kEffortMax) return std::nullopt;
  return effort * kEffortGrowth;
}

}  // namespace armloom
