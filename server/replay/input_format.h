#pragma once

#include <cstdint>
#include <string>

#include "core/executive/executive_input.h"
#include "server/codec/format.h"

namespace armloom {

// The log of inputs (inputs.jsonl of a recording). First a line of this; then each input with the
// control cycles that had begun before it: {"ticks": 1204, "input": "cancel", "job": "a"}.
// What a line holds reads back the same to the last bit (replay.h).
struct InputLogHead {
  static constexpr int kVersion = 1;
  std::string policy;           // in force
  std::uint64_t seed = 1;       // of the simulated arms
  std::uint64_t first_job = 1;  // ExecutiveOptions::first_job
  int version = kVersion;
};
[[nodiscard]] FormatPtr<InputLogHead> input_log_head_format();

struct LoggedInput {
  std::uint64_t ticks = 0;
  ExecutiveInput input;
};
[[nodiscard]] FormatPtr<LoggedInput> logged_input_format();

}  // namespace armloom
