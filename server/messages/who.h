#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// A person's name; may be empty but not blank.
[[nodiscard]] FormatPtr<std::string> who_format();

}  // namespace armloom
