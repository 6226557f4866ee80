#include "test/experiments/job_maker.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace armloom::experiments {
namespace {

constexpr const char* kTool = "panda_hand_tcp";
// No job must expire.
constexpr Duration kPatience = std::chrono::minutes(20);

}  // namespace

JobMaker::JobMaker(CellPtr cell, std::uint64_t seed)
    : cell_(std::move(cell)), random_(seed), places_(cell_), jobs_(cell_->arms.size()) {}

std::optional<Eigen::VectorXd> JobMaker::tool_at(ArmId arm, const Eigen::Vector3d& p_WT) const {
  const Robot& robot = cell_->robots[cell_->arm(arm).robot.index()];
  const Eigen::Vector3d p_BT = robot.X_WB.inverse() * p_WT;
  Eigen::VectorXd guess(7);
  guess << std::atan2(p_BT.y(), p_BT.x()), 0.0, 0.0, -2.2, 0.0, 2.2, 0.785;
  return tool_down(*cell_, arm, robot.prefix + kTool, p_WT, guess);
}

Eigen::Vector3d JobMaker::from_base(ArmId arm, const Eigen::Vector3d& p_BT) const {
  return cell_->robots[cell_->arm(arm).robot.index()].X_WB * p_BT;
}

std::vector<PlannedJob> JobMaker::drafted(ArmId arm, TimePoint at,
                                          const std::vector<Draft>& drafts) const {
  const std::vector<PlannedJob>& before = jobs_[arm.index()];
  Eigen::VectorXd start = before.empty() ? home(arm) : before.back().trajectory->goal();
  std::vector<PlannedJob> jobs;
  for (const Draft& draft : drafts) {
    TrajectoryRequest request = way(*cell_, arm, start, draft.legs);
    auto trajectory = validate(request, *cell_);
    if (!trajectory) throw std::runtime_error(trajectory.error().front().detail);
    JobRequest job;
    job.key = cell_->arm(arm).name + "-" + std::to_string(before.size() + jobs.size() + 1) + "-" +
              draft.kind;
    job.trajectory = std::move(request);
    job.terms.priority = draft.priority;
    job.terms.backlog_timeout = kPatience;
    jobs.push_back({arm, draft.kind, {at, std::move(job)}, *trajectory});
    start = draft.legs.back().q;
  }
  return jobs;
}

bool JobMaker::add(ArmId arm, TimePoint at, const std::vector<Draft>& drafts) {
  std::vector<PlannedJob> jobs = drafted(arm, at, drafts);
  std::vector<Rest> rests;
  for (const Draft& draft : drafts) {
    if (draft.legs.back().q != home(arm)) rests.push_back({arm, draft.legs.back().q});
  }
  if (!open(jobs, rests)) return false;
  std::ranges::move(jobs, std::back_inserter(jobs_[arm.index()]));
  std::ranges::move(rests, std::back_inserter(rests_));
  return true;
}

void JobMaker::add_trip(ArmId arm, const std::vector<Draft>& drafts) {
  if (drafts.back().legs.back().q != home(arm)) throw std::invalid_argument("a trip ends at home");
  std::ranges::move(drafted(arm, TimePoint{}, drafts), std::back_inserter(jobs_[arm.index()]));
}

bool JobMaker::open(const std::vector<PlannedJob>& jobs, const std::vector<Rest>& rests) {
  for (const PlannedJob& job : jobs) {
    if (!places_.clear_alone(*job.trajectory)) return false;
    for (const Rest& rest : rests_) {
      if (rest.arm != job.arm && !places_.clear_beside(*job.trajectory, rest.arm, rest.q)) {
        return false;
      }
    }
  }
  for (const Rest& rest : rests) {
    for (const std::vector<PlannedJob>& others : jobs_) {
      for (const PlannedJob& other : others) {
        if (other.arm != rest.arm && !places_.clear_beside(*other.trajectory, rest.arm, rest.q)) {
          return false;
        }
      }
    }
  }
  return true;
}

std::vector<PlannedJob> JobMaker::take(std::size_t each) {
  std::vector<std::size_t> turn(jobs_.size());
  for (std::size_t i = 0; i < turn.size(); ++i) turn[i] = i;
  std::vector<PlannedJob> all;
  const std::size_t most =
      std::ranges::max(jobs_, {}, [](const auto& jobs) { return jobs.size(); }).size();
  for (std::size_t first = 0; first < most; first += each) {
    for (std::size_t i = turn.size(); i > 1; --i) std::swap(turn[i - 1], turn[random_() % i]);
    for (const std::size_t arm : turn) {
      const std::size_t last = std::min(first + each, jobs_[arm].size());
      for (std::size_t i = first; i < last; ++i) all.push_back(std::move(jobs_[arm][i]));
    }
  }
  std::ranges::stable_sort(all, {}, [](const PlannedJob& job) { return job.timed.at; });
  jobs_.assign(jobs_.size(), {});
  rests_.clear();
  return all;
}

}  // namespace armloom::experiments
