#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/executive/events.h"
#include "core/planning/plan_goal.h"
#include "server/codec/format.h"

namespace armloom {

// The body of POST /control.
struct ControlRequest {
  std::optional<std::string> who = {};  // for people; a token's name counts instead
  bool take = false;                    // from whoever holds it
};
[[nodiscard]] FormatPtr<ControlRequest> control_request_format();
[[nodiscard]] Result<ControlRequest> read_control_request(std::string_view text);

// Who holds it; the answer to GET /control has no key.
struct ControlView {
  struct Holder {
    std::string who;
    std::string since_at;            // RFC 3339, UTC
    std::optional<std::string> arm;  // that was moved by hand last
    std::optional<std::string> job;
  };
  std::optional<Holder> holder;
  std::optional<std::string> key = {};
};
[[nodiscard]] FormatPtr<ControlView> control_format();
[[nodiscard]] FormatPtr<ControlView> control_taken_format();

// The bodies of POST /control/release and PUT /arms/{name}/hold.
struct ControlKey {
  std::string control;
};
[[nodiscard]] FormatPtr<ControlKey> control_key_format();
[[nodiscard]] Result<ControlKey> read_control_key(std::string_view text);

// The body of POST /arms/{name}/hold.
struct HoldRequest {
  std::string control;
  PlanGoal to;
  double speed = 0.1;
};
inline constexpr double kHoldSpeedMax = 0.25;
[[nodiscard]] FormatPtr<HoldRequest> hold_request_format();
[[nodiscard]] Result<HoldRequest> read_hold_request(std::string_view text);

// The body of POST /jobs that is such a move of this arm.
[[nodiscard]] std::string job_text_of(const HoldRequest& hold, const std::string& arm);

// The answer to both.
struct HoldView {
  JobView job;
  double lease_s;  // of wall time
};
[[nodiscard]] FormatPtr<HoldView> hold_format();

}  // namespace armloom
