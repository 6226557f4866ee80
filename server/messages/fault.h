#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/executive.h"
#include "server/codec/format.h"

namespace armloom {

// Body of POST /sim/faults. Required values: for `slow` a share of the speed in 0..1, for
// `late_start` seconds. Problem "unsupported-fault": a kind that simulated arms do not have.
[[nodiscard]] FormatPtr<FaultRequest> fault_request_format();
[[nodiscard]] Result<FaultRequest> read_fault_text(std::string_view text);

// Reads an array of such bodies, each with "at_s". Arms must be in `cell`.
[[nodiscard]] Result<std::vector<FaultRequest>> read_faults_text(std::string_view text,
                                                                 const Cell& cell);

// Answer to POST /sim/faults.
struct FaultView {
  std::uint64_t id;
  FaultRequest fault;
};
[[nodiscard]] FormatPtr<FaultView> fault_format();
// Describes a fault in the input log, without id; read as strictly as a request.
[[nodiscard]] FormatPtr<FaultRequest> logged_fault_format();

// Body and answer of PUT /sim/speed.
struct SimulationSpeed {
  inline static constexpr double kMin = 0.001;
  inline static constexpr double kMax = 1000.0;
  double speed = 1.0;  // cell seconds per wall second
};
[[nodiscard]] FormatPtr<SimulationSpeed> speed_format();

}  // namespace armloom
