#include "core/executive/execution.h"

#include <utility>

namespace armloom {
namespace {

std::vector<std::unique_ptr<ArmController>> controllers(std::vector<MadeController> made) {
  std::vector<std::unique_ptr<ArmController>> all;
  for (MadeController& arm : made) all.push_back(std::move(arm.controller));
  return all;
}

}  // namespace

Execution::Execution(const CellPtr& cell, Made made, StartLog* log, ArmFaults::Asked asked,
                     AuthorityGate::Calls calls)
    : faults_(cell, made.arms, std::move(asked)),
      motions_(cell, controllers(std::move(made.arms)), cell->home()),
      gate_(cell, motions_, std::move(made.scene), std::move(calls)),
      starts_(log) {}

void Execution::carry_out(const Dispatch& dispatch, const Step& step,
                          std::function<bool(StepId)> written) {
  // A later motion of a task: the task's start is recorded.
  const bool is_later = step.job->task && *step.job->task != step.id.job;
  if (step.job->system_job || is_later) return gate_.dispatch(dispatch, step.trajectory);
  const auto open = [this, id = dispatch.step, written = std::move(written)] {
    const bool moves = written(id);
    const auto withheld = starts_.open(id.job);
    if (withheld && moves) gate_.grant({id, *withheld});
  };
  gate_.dispatch(starts_.pass(dispatch, open), step.trajectory);
}

bool Execution::record_start(JobId job, std::function<void(JobId)> written) {
  return starts_.record(job, [this, job, written = std::move(written)] {
    (void)starts_.open(job);
    written(job);
  });
}

void Execution::carry_out(const Grant& grant) {
  if (!starts_.keeps(grant)) gate_.grant(grant);
}

bool Execution::keeps_back(const MotionReport& report) const {
  return report.kind == MotionReport::Kind::progressed && starts_.withholds(report.step.job);
}

void Execution::forget(const Step& ended) {
  starts_.forget(ended.id.job);
  gate_.forget(ended.trajectory);
}

}  // namespace armloom
