#include "test/experiments/shuttles.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

namespace armloom::experiments {
namespace {

using Pose = std::array<double, 7>;  // rad

// Poses of panda_two from the planning environments of mr_planner (panda1 is left). The straight
// motion from home keeps 4 cm from the other arm at home and from the table. Their names, in order:
// ready, twist_left, twist_right, mirror, left_push, coop_up, coop_down, tiled_up, tiled_down.
constexpr Pose kLeft[] = {
    {0.0, -0.5, 0.0, -1.5, 0.0, 1.0, 0.0},
    {-1.4202, 1.0485, 0.284, -1.5, 2.2535, 1.0, 0.0},
    {0.2949, 0.3483, 0.7806, -1.6474, 0.0, 2.094, 0.0},
    {-0.25, 0.0, -0.312, -2.0262, 1.2481, 0.7075, 0.0},
    {1.5, -0.3, 0.0, -2.0, 0.0, 1.8, 0.0},
    {0.0, -0.7, 0.0, -1.8, 0.0, 2.6, 0.0},
    {0.0, -0.5, 0.0, -2.9, 0.0, 2.4, 0.0},
    {0.0, -0.25, 0.0, -1.6, 0.0, 2.7, 0.0},
    {0.0, -0.3, 0.0, -2.0, 0.0, 0.8, 0.0},
};
// In order: ready, twist_left, twist_right, mirror, right_push, coop_up, coop_down, tiled_down.
constexpr Pose kRight[] = {
    {0.0, -0.5, 0.0, -1.5, 0.0, 1.0, 0.0},
    {0.2949, 0.3483, 0.7807, -1.6474, 0.0, 2.082, 0.0},
    {-1.4201, 1.0485, 0.2839, -1.5, 2.2535, 1.0, 0.0},
    {-0.25, 0.0, -0.312, -2.0231, 1.2481, 0.7015, 0.0},
    {1.5, -0.3, 0.0, -2.0, 0.0, 1.8, 0.0},
    {0.0, -0.7, 0.0, -1.8, 0.0, 2.6, 0.0},
    {0.0, -0.5, 0.0, -2.9, 0.0, 2.4, 0.0},
    {0.0, 0.0, 0.0, -2.6, 0.0, 2.5, 0.0},
};
constexpr std::span<const Pose> kPoses[] = {kLeft, kRight};
constexpr int kVisits = 12;
constexpr int kToGive = 15;
constexpr int kOwn = 5;
constexpr int kMoreTrips = 10;
constexpr int kFewerTrips = 8;

std::size_t drawn(JobMaker& maker, ArmId arm) {
  return maker.random()() % kPoses[arm.index()].size();
}
Eigen::VectorXd pose_of(ArmId arm, std::size_t pose) {
  const Pose& q = kPoses[arm.index()][pose];
  return Eigen::VectorXd::Map(q.data(), q.size());
}
void add_visit(JobMaker& maker, ArmId arm, std::size_t pose) {
  maker.add_trip(arm, {{"visit", {{pose_of(arm, pose)}, {maker.home(arm)}}}});
}

// Returns the candidate jobs of each visit: one job per arm, or a single job if one arm has to make
// the visit.
std::vector<std::vector<PlannedJob>> visits_to_give(const CellPtr& cell, std::uint64_t seed) {
  std::vector<std::vector<PlannedJob>> all;
  JobMaker maker(cell, seed);
  const ArmId busier(seed % 2 == 1 ? 0 : 1);
  for (int visit = 0; visit < kToGive + kOwn; ++visit) {
    const bool own = visit % 4 == 3;
    for (std::uint32_t arm = 0; arm < std::size(kPoses); ++arm) {
      if (!own || ArmId(arm) == busier) add_visit(maker, ArmId(arm), drawn(maker, ArmId(arm)));
    }
    std::vector<PlannedJob> jobs = maker.take();
    std::ranges::sort(jobs, {}, &PlannedJob::arm);
    for (PlannedJob& job : jobs) job.timed.job.key = "visit-" + std::to_string(visit + 1);
    all.push_back(std::move(jobs));
  }
  return all;
}

}  // namespace

std::vector<PlannedJob> shuttle_jobs(const CellPtr& cell, std::uint64_t seed) {
  JobMaker maker(cell, seed);
  for (std::uint32_t i = 0; i < std::size(kPoses); ++i) {
    const ArmId arm(i);
    const int trips = seed % 2 == 1 - i ? kMoreTrips : kFewerTrips;
    for (int trip = 0; trip < trips; ++trip) {
      maker.add_trip(arm,
                     {{"out", {{pose_of(arm, drawn(maker, arm))}}}, {"home", {{maker.home(arm)}}}});
    }
  }
  return maker.take(2);
}

std::vector<PlannedJob> visits(const CellPtr& cell, std::uint64_t seed) {
  JobMaker maker(cell, seed);
  for (std::uint32_t i = 0; i < std::size(kPoses); ++i) {
    const ArmId arm(i);
    std::vector<std::size_t> poses;
    for (int visit = 0; visit < kVisits; ++visit) poses.push_back(drawn(maker, arm));
    std::ranges::sort(poses);
    for (const std::size_t pose : poses) add_visit(maker, arm, pose);
  }
  return maker.take();
}

std::vector<PlannedJob> visits_in_turn(const CellPtr& cell, std::uint64_t seed) {
  std::vector<PlannedJob> jobs;
  std::size_t given = 0;
  for (std::vector<PlannedJob>& either : visits_to_give(cell, seed)) {
    jobs.push_back(std::move(either.size() > 1 ? either[given++ % either.size()] : either.front()));
  }
  return jobs;
}

std::vector<PlannedJob> visits_by_either(const CellPtr& cell, std::uint64_t seed) {
  std::vector<PlannedJob> jobs;
  for (std::vector<PlannedJob>& either : visits_to_give(cell, seed)) {
    PlannedJob& job = jobs.emplace_back(either.front());
    if (either.size() == 1) continue;
    for (PlannedJob& one : either) {
      job.timed.job.alternatives.push_back(std::move(one.timed.job.trajectory));
    }
    job.timed.job.trajectory = {};
  }
  return jobs;
}

}  // namespace armloom::experiments
