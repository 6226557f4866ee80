#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// Describes a person's name. It may be empty, but must not consist of white space only.
[[nodiscard]] FormatPtr<std::string> who_format();

}  // namespace armloom
