#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/executive.h"
#include "server/codec/format.h"

namespace armloom {

// Body of POST /sim/faults. The kinds of faults, with the ranges and defaults of their values, are
// a table in fault.cc.
[[nodiscard]] FormatPtr<FaultRequest> fault_request_format();
[[nodiscard]] Result<FaultRequest> read_fault_text(std::string_view text);

// Returns true if faults of this kind have a value.
[[nodiscard]] bool has_value(std::string_view kind);

// Reads an array of bodies of POST /sim/faults. Each body must have "at_s" and an arm of `cell`.
[[nodiscard]] Result<std::vector<FaultRequest>> read_faults_text(std::string_view text,
                                                                 const Cell& cell);

// Answer to POST /sim/faults.
struct FaultView {
  std::uint64_t id;
  FaultRequest fault;
  std::optional<Duration> remaining = {};  // only in a FaultListing
};
[[nodiscard]] FormatPtr<FaultView> fault_format();
// Answer to GET /sim/faults: the faults that are not over.
struct FaultListing {
  TimePoint now;
  std::vector<FaultView> faults;
};
[[nodiscard]] FormatPtr<FaultListing> fault_list_format();
// Describes a fault in the input log, whose id is not kept. Values are checked as strictly as in a
// request.
[[nodiscard]] FormatPtr<FaultRequest> logged_fault_format();

// Body and answer of PUT /sim/speed.
struct SimulationSpeed {
  inline static constexpr double kMin = 0.001;
  inline static constexpr double kMax = 1000.0;
  double speed = 1.0;  // cell seconds per wall second
};
[[nodiscard]] FormatPtr<SimulationSpeed> speed_format();

}  // namespace armloom
