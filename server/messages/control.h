#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/executive/events.h"
#include "core/planning/plan_goal.h"
#include "server/codec/format.h"

namespace armloom {

// Body of POST /control.
struct ControlRequest {
  std::optional<std::string> who = {};  // display name; with tokens, the token's name applies
  bool take = false;                    // take control from another client
};
[[nodiscard]] FormatPtr<ControlRequest> control_request_format();
[[nodiscard]] Result<ControlRequest> read_control_request(std::string_view text);

// The client that has control. Only the answer to POST /control has the key.
struct ControlView {
  struct Holder {
    std::string who;
    std::string since_at;            // RFC 3339, UTC
    std::optional<std::string> arm;  // last jogged by the holder
    std::optional<std::string> job;
  };
  std::optional<Holder> holder;
  std::optional<std::string> key = {};
};
[[nodiscard]] FormatPtr<ControlView> control_format();
[[nodiscard]] FormatPtr<ControlView> control_taken_format();

// Body of POST /control/release and of PUT /arms/{name}/jog.
struct ControlKey {
  std::string control;
};
[[nodiscard]] FormatPtr<ControlKey> control_key_format();
[[nodiscard]] Result<ControlKey> read_control_key(std::string_view text);

// Body of POST /arms/{name}/jog.
struct JogRequest {
  std::string control;
  PlanGoal to;
  double speed = 0.1;
};
inline constexpr double kJogSpeedMax = 0.25;
[[nodiscard]] FormatPtr<JogRequest> jog_request_format();
[[nodiscard]] Result<JogRequest> read_jog_request(std::string_view text);

// Returns the body of POST /jobs that does the same on this arm.
[[nodiscard]] std::string job_text_of(const JogRequest& jog, const std::string& arm);

// Answer to POST and PUT /arms/{name}/jog.
struct JogView {
  JobView job;
  double lease_s;  // wall time
};
[[nodiscard]] FormatPtr<JogView> jog_format();

}  // namespace armloom
