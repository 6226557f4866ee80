#include "core/executive/timeline.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/executive/views.h"

namespace armloom {
namespace {

class StatusNames final : public JobNames {
 public:
  StatusNames(const Status& status, const Cell& cell) : status_(status), cell_(cell) {}

  std::string key(JobId job) const override {
    const auto known = status_.jobs.find(job);
    return known ? known->key : std::string();
  }
  std::string name(JobId job) const override {
    const auto known = status_.jobs.find(job);
    return known ? known->name : std::string();
  }
  bool has_job(ArmId arm) const override {
    bool has = false;
    status_.jobs.newest_first([&](const JobSheet::JobPtr& job) {
      has = !is_terminal(job->state) &&
            std::ranges::find(job->arms, cell_.arm(arm).name) != job->arms.end();
      return !has;
    });
    return has;
  }
  bool is_stopped(ArmId arm) const override { return status_.arms[arm.index()].stopped; }

 private:
  const Status& status_;
  const Cell& cell_;
};

TimelineLanes::Leg leg_of(const PredictedLeg& leg, const JobSheet::JobPtr& job, const Cell& cell,
                          const JobNames& names) {
  TimelineLanes::Leg told{.job = *job, .starts = leg.starts, .ends = leg.ends, .pauses = {}};
  for (const PredictedPause& pause : leg.pauses) {
    std::optional<WaitView> waits_on;
    if (pause.waits_on) waits_on = view_of(*pause.waits_on, cell, names);
    told.pauses.push_back({pause.from, pause.to, pause.at, std::move(waits_on)});
  }
  return told;
}

}  // namespace

TimelineLanes lanes_of(const TimelineView& timeline, const Cell& cell) {
  const Status& status = timeline.status;
  const StatusNames names(status, cell);
  TimelineLanes view{
      .now = timeline.predicted.now, .horizon_steps = timeline.horizon_steps, .lanes = {}};
  for (const Arm& arm : cell.arms) view.lanes.push_back({.arm = arm.name, .steps = {}});
  const auto in_lanes_of = [&](const JobView& job, auto change) {
    for (const std::string& arm : job.arms) change(view.lanes[cell.find_arm(arm)->index()]);
  };
  std::set<JobId> legs;
  for (const PredictedLeg& leg : timeline.predicted.legs) {
    const auto job = status.jobs.find(leg.step.job);
    if (!job) continue;
    legs.insert(leg.step.job);
    const TimelineLanes::Leg told = leg_of(leg, status.with_progress(job), cell, names);
    in_lanes_of(*job, [&](TimelineLanes::Lane& lane) { lane.steps.push_back(told); });
  }
  status.jobs.each([&](const JobSheet::JobPtr& job) {
    if (is_terminal(job->state) || legs.contains(job->id)) return;
    in_lanes_of(*job, [](TimelineLanes::Lane& lane) { ++lane.waiting; });
  });
  return view;
}

}  // namespace armloom
