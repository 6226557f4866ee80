#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/events.h"
#include "core/executive/status_board.h"
#include "core/jobs/timeline.h"

namespace armloom {

// What is expected of the arms, as the strand knows it at one instant.
struct TimelineView {
  PredictedTimeline predicted;
  std::uint64_t horizon_steps = 0;
  Status status;  // of the same instant
};

// What clients see of it, lane by lane. A motion of several arms stands in the lane of each. Every
// job that has not ended is a leg or waits, in the lanes of its `arms`. Times are cell time.
struct TimelineLanes {
  struct Pause {
    TimePoint from;
    std::optional<TimePoint> to;
    Duration at;
    std::optional<WaitView> waits_on;
  };
  struct Leg {
    JobView job;
    std::optional<TimePoint> starts;
    std::optional<TimePoint> ends;
    std::vector<Pause> pauses;
  };
  struct Lane {
    std::string arm;
    std::vector<Leg> steps;     // in the order in which they go
    std::uint64_t waiting = 0;  // jobs of the arm that are no leg
  };
  TimePoint now;
  std::uint64_t horizon_steps = 0;
  std::vector<Lane> lanes;  // by ArmId
};

// On any thread.
[[nodiscard]] TimelineLanes lanes_of(const TimelineView& timeline, const Cell& cell);

}  // namespace armloom
