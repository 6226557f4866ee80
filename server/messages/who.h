#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// A person's name as given by the client; may be empty. A blank name is refused, because it would
// be displayed as no name.
[[nodiscard]] FormatPtr<std::string> who_format();

}  // namespace armloom
