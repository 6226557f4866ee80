#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/events.h"
#include "core/executive/status_board.h"
#include "core/jobs/timeline.h"

namespace armloom {

// The predicted timeline and the status at the same instant.
struct TimelineView {
  PredictedTimeline predicted;
  std::uint64_t horizon_steps = 0;
  Status status;
};

// The timeline for clients, with one lane per arm. A motion of several arms is in the lanes of all
// its arms. Every active job is either a leg in `steps` or included in `waiting`, in the lanes of
// its `arms`. Times are cell time.
struct TimelineLanes {
  // Views of a PredictedPause and a PredictedLeg with the words that clients see.
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
    std::vector<Leg> steps;     // in running order
    std::uint64_t waiting = 0;  // jobs of the arm that are not in `steps`
  };
  TimePoint now;
  std::uint64_t horizon_steps = 0;
  std::vector<Lane> lanes;  // by ArmId
};

// Thread-safe.
[[nodiscard]] TimelineLanes lanes_of(const TimelineView& timeline, const Cell& cell);

}  // namespace armloom
