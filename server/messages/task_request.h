#pragma once

#include "core/executive/task_request.h"
#include "server/codec/format.h"

namespace armloom {

// Describes a step of a job: a motion, or an action between motions.
[[nodiscard]] FormatPtr<StepRequest> step_request_format();

inline constexpr std::size_t kStepsMax = 100;     // of one job
inline constexpr std::size_t kTriggersMax = 100;  // of one motion

}  // namespace armloom
