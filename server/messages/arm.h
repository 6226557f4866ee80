#pragma once

#include <vector>

#include "core/executive/events.h"
#include "server/codec/format.h"

namespace armloom {

[[nodiscard]] FormatPtr<ArmView> arm_format();
[[nodiscard]] FormatPtr<std::vector<ArmView>> arm_list_format();

// Answer to POST /stop and /resume.
struct Stopped {
  bool stopped;  // every arm
  std::vector<std::string> not_resumed = {};
};
[[nodiscard]] FormatPtr<Stopped> stopped_format();

// Answers to GET /healthz and /readyz.
struct Health {};
[[nodiscard]] FormatPtr<Health> health_format();
struct Ready {
  TimePoint now;
};
[[nodiscard]] FormatPtr<Ready> ready_format();

}  // namespace armloom
