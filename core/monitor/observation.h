#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// When a controller measured a report, on its own clock, which starts anywhere. Cell time cannot
// tell how much time passed between two reports: a busy server takes several reports at once, and
// its cell time slips.
struct ReportTime {
  std::uint64_t connection = 0;
  Duration at{};
};
// Returns the time between the measurements of two reports; nullopt if `now` is not the later one,
// or if they came over two connections: the controller's clock may have been restarted.
[[nodiscard]] inline std::optional<Duration> since(const ReportTime& before,
                                                   const ReportTime& now) {
  if (before.connection != now.connection || now.at <= before.at) return std::nullopt;
  return now.at - before.at;
}

// The monitor's knowledge of one arm in a period.
struct ArmObservation {
  bool is_connected = true;   // its controller has reported; if false, nothing else is known
  TrajectoryPtr motion = {};  // null if the arm has none
  Duration measured{};        // progress on the motion
  Duration commanded{};
  Duration authority{};      // largest permitted progress
  std::uint64_t starts = 0;  // counts starts and resumes: before each, the arm rested
  double speed = 1.0;        // speed override: largest share of the planned rate
  double brake = 1.0;        // share of the brake that it keeps with what it holds
  // False while the arm waits for its start, moves or brakes.
  bool rests = true;
  bool brakes = false;      // it comes to rest and has no other command
  bool is_stopped = false;  // until it is resumed
  // When its controller reported that it obeys a brake, if no motion was commanded since.
  std::optional<TimePoint> braking_since = {};
  std::optional<Duration> rests_at = {};  // while it brakes: the progress where it will rest
  // Distance from the path at the start of the motion (rad, m), for which it was certified.
  double off_path = 0.0;
  ReportTime reported{};    // of the last report
  Duration feedback_age{};  // of the last report
};

struct Observation {
  TimePoint time;
  Configuration measured;            // all joints of the cell
  std::vector<ArmObservation> arms;  // by ArmId
};

}  // namespace armloom
