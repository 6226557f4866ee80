#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// Describes a person's name, which may be empty but not blank.
[[nodiscard]] FormatPtr<std::string> who_format();

}  // namespace armloom
