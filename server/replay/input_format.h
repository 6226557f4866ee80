#pragma once

#include <cstdint>
#include <string>

#include "core/executive/executive_input.h"
#include "server/codec/format.h"

namespace armloom {

// The input log (inputs.jsonl of a recording). The first line is an InputLogHead. Each further line
// is an input, with the number of control cycles that began before it: {"ticks": 1204, "input":
// "cancel", "job": "a"}. A replay needs exact values, so all values read back the same to the last
// bit (replay.h).
struct InputLogHead {
  static constexpr int kVersion = 2;  // version 1: armloom 0.1
  std::string policy;                 // at the start
  std::uint64_t seed = 1;             // of the simulated arms
  std::uint64_t first_job = 1;        // ExecutiveOptions::first_job
  int version = kVersion;
};
[[nodiscard]] FormatPtr<InputLogHead> input_log_head_format();

struct LoggedInput {
  std::uint64_t ticks = 0;
  ExecutiveInput input;
};
[[nodiscard]] FormatPtr<LoggedInput> logged_input_format();

}  // namespace armloom
