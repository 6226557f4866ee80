#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/executive.h"
#include "server/codec/format.h"

namespace armloom {

// The body of POST /sim/faults. `slow` needs a value within 0..1 (the share of its speed),
// `late_start` one in seconds; the others have none.
// Problem "unsupported-fault": a kind of the contract that the simulated arms do not have.
[[nodiscard]] FormatPtr<FaultRequest> fault_request_format();
[[nodiscard]] Result<FaultRequest> read_fault_text(std::string_view text);

// A file of faults: an array of such bodies, each with its "at_s". Arms are those of `cell`.
[[nodiscard]] Result<std::vector<FaultRequest>> read_faults_text(std::string_view text,
                                                                 const Cell& cell);

// The answer: the fault as it was taken.
struct FaultView {
  std::uint64_t id;
  FaultRequest fault;
};
[[nodiscard]] FormatPtr<FaultView> fault_format();
// The same of one that has no id yet, read back as strictly as a request.
[[nodiscard]] FormatPtr<FaultRequest> logged_fault_format();

// The body of PUT /sim/speed, and the answer.
struct SimulationSpeed {
  inline static constexpr double kMin = 0.001;
  inline static constexpr double kMax = 1000.0;
  double speed = 1.0;  // cell seconds for each second of the wall
};
[[nodiscard]] FormatPtr<SimulationSpeed> speed_format();

}  // namespace armloom
