#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/events.h"
#include "core/executive/views.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// What clients see of a PredictedTimeline, lane by lane. A motion of several arms stands in the
// lane of each. Times are cell time.
struct TimelineView {
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
    std::vector<Leg> legs;      // in the order in which they go
    std::uint64_t waiting = 0;  // jobs of the arm that are not admitted
  };
  TimePoint now;
  std::uint64_t horizon_legs = 0;
  std::vector<Lane> lanes;  // by ArmId
};

[[nodiscard]] TimelineView timeline_of(const Scheduler& scheduler, TimePoint now, const Cell& cell,
                                       const JobNames& names);

}  // namespace armloom
