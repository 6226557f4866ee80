#pragma once

#include "core/executive/timeline.h"
#include "server/codec/object_format.h"

namespace armloom {

// Answer to GET /timeline.
[[nodiscard]] FormatPtr<TimelineLanes> timeline_format();

}  // namespace armloom
