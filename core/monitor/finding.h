#pragma once

#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/proximity.h"

namespace armloom {

// A condition that ends for less than this time is not reported again when it returns, unless the
// finding stops an arm that is not stopped. So noise around a limit does not cause many findings.
inline constexpr Duration kSameCondition = std::chrono::seconds(1);

// A finding of the monitor, and the arms to be stopped for it (README.md).
struct MonitorFinding {
  enum class Kind {
    contact,               // two bodies touch
    clearance,             // two bodies are too close
    approach,              // two bodies will be too close unless an arm stops now
    deviation,             // an arm left its path
    unplanned_motion,      // an arm without a motion leaves the position where it rested
    early_finish,          // a controller reported "finished" away from the goal
    beyond_authority,      // an arm passed its authority, or cannot rest there any more
    stop_ignored,          // an arm still moves although it was told to brake
    late_feedback,         // no new feedback within the controller's timeout
    frozen_feedback,       // new feedback, but positions do not follow the commanded progress
    implausible_feedback,  // positions changed faster than the joints can move
  };
  Kind kind;
  TimePoint time;
  Proximity proximity = {};           // contact, clearance, approach: which bodies, how close
  double limit_m = 0.0;               // likewise: the required distance
  std::vector<ArmId> stops = {};      // ascending
  std::optional<ArmId> arm = {};      // the arm that violates a premise
  std::optional<JointId> joint = {};  // the joint with the largest value, if there is one
  // Premises: measured value and limit. Feedback, beyond_authority and stop_ignored: s;
  // others: rad or m, of `joint`.
  double value = 0.0;
  double limit = 0.0;
};
[[nodiscard]] constexpr const char* to_string(MonitorFinding::Kind kind) {
  switch (kind) {
    case MonitorFinding::Kind::contact:
      return "contact";
    case MonitorFinding::Kind::clearance:
      return "clearance";
    case MonitorFinding::Kind::approach:
      return "approach";
    case MonitorFinding::Kind::deviation:
      return "deviation";
    case MonitorFinding::Kind::unplanned_motion:
      return "unplanned_motion";
    case MonitorFinding::Kind::early_finish:
      return "early_finish";
    case MonitorFinding::Kind::beyond_authority:
      return "beyond_authority";
    case MonitorFinding::Kind::stop_ignored:
      return "stop_ignored";
    case MonitorFinding::Kind::late_feedback:
      return "late_feedback";
    case MonitorFinding::Kind::frozen_feedback:
      return "frozen_feedback";
    case MonitorFinding::Kind::implausible_feedback:
      return "implausible_feedback";
  }
  return nullptr;
}
// Returns true if the finding is about a pair of bodies: `proximity` and `limit_m` are set.
[[nodiscard]] constexpr bool is_about_pair(MonitorFinding::Kind kind) {
  return kind == MonitorFinding::Kind::contact || kind == MonitorFinding::Kind::clearance ||
         kind == MonitorFinding::Kind::approach;
}

}  // namespace armloom
