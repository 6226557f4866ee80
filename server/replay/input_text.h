#pragma once

#include <cstdint>
#include <string>

#include "core/executive/executive_input.h"
#include "core/model/cell.h"

namespace armloom {

// The log of inputs (inputs.jsonl of a recording), in text. First a line of this; then each input
// with the control cycles that had begun before it: {"ticks": 1204, "input": "cancel", "job": "a"}.
// What a line holds reads back the same to the last bit (replay.h).
struct InputLogHead {
  static constexpr int kVersion = 1;
  std::string policy;           // in force
  std::uint64_t seed = 1;       // of the simulated arms
  std::uint64_t first_job = 1;  // ExecutiveOptions::first_job
};
[[nodiscard]] std::string head_text(const InputLogHead& head);
[[nodiscard]] std::string input_text(std::uint64_t ticks, const ExecutiveInput& input,
                                     const Cell& cell);

}  // namespace armloom
