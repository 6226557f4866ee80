#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// Who does something, as they say themselves: a name for people, or nothing. What is blank would be
// told as nobody.
[[nodiscard]] FormatPtr<std::string> who_format();

}  // namespace armloom
