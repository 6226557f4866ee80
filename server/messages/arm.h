#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/events.h"
#include "server/codec/format.h"

namespace armloom {

[[nodiscard]] FormatPtr<ArmView> arm_format();
[[nodiscard]] FormatPtr<std::vector<ArmView>> arm_list_format();

// Body and answer of PUT /speed, and body of PUT /arms/{name}/speed.
struct SpeedShare {
  double share;  // SpeedOverride::is_valid()
};
[[nodiscard]] FormatPtr<SpeedShare> speed_override_format();
[[nodiscard]] Result<SpeedShare> read_speed_override(std::string_view text);
// Answer to GET and PUT /arms/{name}/speed: the members of an arm that concern its speed.
[[nodiscard]] FormatPtr<ArmView> arm_speed_format();

// Answer to POST /stop and /resume.
struct Stopped {
  bool stopped;                      // every arm
  std::optional<int> category = {};  // of a stop
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
