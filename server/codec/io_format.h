#pragma once

#include "core/model/io_description.h"
#include "server/codec/format.h"

namespace armloom {

// Describes true, false, or a whole number from 0 to 65535.
[[nodiscard]] FormatPtr<SignalValue> signal_value_format();
// Describes the member "io" of a cell file.
[[nodiscard]] FormatPtr<IoDescription> io_format();

}  // namespace armloom
