#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "server/codec/format.h"
#include "server/store/stored_alert.h"

namespace armloom {

// GET /alerts
struct AlertList {
  std::vector<StoredAlert> alerts;
};
[[nodiscard]] FormatPtr<AlertList> alert_list_format();

// POST /alerts/acknowledge
struct AlertsSeen {
  std::vector<std::string> ids;
  std::optional<std::string> who = {};
};
[[nodiscard]] FormatPtr<AlertsSeen> alerts_seen_format();
[[nodiscard]] Result<AlertsSeen> read_alerts_seen(std::string_view text);

}  // namespace armloom
