#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/executive.h"

namespace armloom {

// The body of POST /sim/faults: {"arm", "kind", "at_s", "for_s", "value"}. `slow` needs a value
// within 0..1 (the share of its speed), `late_start` one in seconds; the others read over it.
// Problem "unsupported-fault": a kind of the contract that the simulated arms do not have.
[[nodiscard]] Result<FaultRequest> read_fault_text(std::string_view text);

// A file of faults: an array of such bodies, each with its "at_s". Arms are those of `cell`.
[[nodiscard]] Result<std::vector<FaultRequest>> read_faults_text(std::string_view text,
                                                                 const Cell& cell);

[[nodiscard]] std::string fault_json(std::uint64_t id, const FaultRequest& fault);

// The body of PUT /sim/speed: {"speed": x}, cell seconds for each second of the wall.
inline constexpr double kSpeedMin = 0.001;
inline constexpr double kSpeedMax = 1000.0;
[[nodiscard]] Result<double> read_speed_text(std::string_view text);

}  // namespace armloom
