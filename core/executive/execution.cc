#include "core/executive/execution.h"

#include <iterator>
#include <utility>

namespace armloom {
namespace {

std::vector<std::unique_ptr<ArmController>> controllers(
    std::vector<std::unique_ptr<FaultyArm>> arms) {
  return {std::make_move_iterator(arms.begin()), std::make_move_iterator(arms.end())};
}

}  // namespace

Execution::Execution(const CellPtr& cell, std::vector<std::unique_ptr<FaultyArm>> arms,
                     StartLog* log, ArmFaults::Asked asked)
    : faults_(cell, arms, std::move(asked)),
      motions_(cell, controllers(std::move(arms)), cell->home()),
      starts_(log) {}

void Execution::carry_out(const Dispatch& dispatch, const Job& job,
                          std::function<bool(JobId)> written) {
  if (job.system_job) return motions_.dispatch(dispatch, job.trajectory);
  const auto open = [this, id = job.id, written = std::move(written)] {
    const bool moves = written(id);
    const auto withheld = starts_.open(id);
    if (withheld && moves) motions_.grant({id, *withheld});
  };
  motions_.dispatch(starts_.pass(dispatch, open), job.trajectory);
}

void Execution::carry_out(const Grant& grant) {
  if (!starts_.keeps(grant)) motions_.grant(grant);
}

bool Execution::keeps_back(const MotionReport& report) const {
  return report.kind == MotionReport::Kind::progressed && starts_.withholds(report.job);
}

}  // namespace armloom
