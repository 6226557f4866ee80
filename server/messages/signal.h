#pragma once

#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/events.h"
#include "server/codec/format.h"

namespace armloom {

// An input or output of the cell.
[[nodiscard]] FormatPtr<SignalView> signal_format();
// Answer to GET /io.
struct SignalList {
  std::vector<SignalView> signals;
};
[[nodiscard]] FormatPtr<SignalList> signal_list_format();

// Body of PUT /io/{name}.
struct SignalRequest {
  SignalValue value;
};
[[nodiscard]] FormatPtr<SignalRequest> signal_request_format();
[[nodiscard]] Result<SignalRequest> read_signal_request(std::string_view text);

}  // namespace armloom
