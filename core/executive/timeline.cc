#include "core/executive/timeline.h"

#include <utility>

namespace armloom {

TimelineView timeline_of(const Scheduler& scheduler, TimePoint now, const Cell& cell,
                         const JobNames& names) {
  const PredictedTimeline predicted = scheduler.timeline(now);
  TimelineView view{
      .now = predicted.now, .horizon_legs = scheduler.policy().horizon(), .lanes = {}};
  for (std::size_t arm = 0; arm < cell.arms.size(); ++arm) {
    view.lanes.push_back(
        {.arm = cell.arms[arm].name, .legs = {}, .waiting = predicted.waiting[arm]});
  }
  for (const PredictedLeg& leg : predicted.legs) {
    const Job& job = *scheduler.find(leg.job);
    TimelineView::Leg told{
        .job = view_of(job, cell, names), .starts = leg.starts, .ends = leg.ends, .pauses = {}};
    for (const PredictedPause& pause : leg.pauses) {
      std::optional<WaitView> waits_on;
      if (pause.waits_on) waits_on = view_of(*pause.waits_on, cell, names);
      told.pauses.push_back({pause.from, pause.to, pause.at, std::move(waits_on)});
    }
    for (ArmId arm : job.trajectory->arms()) view.lanes[arm.index()].legs.push_back(told);
  }
  return view;
}

}  // namespace armloom
