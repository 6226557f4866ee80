#include "test/scenarios/random_jobs.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "test/scenarios/star.h"
#include "test/scenarios/team_world.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

CellDescription sliders(Random& random) {
  if (random.chance(0.7)) return team_cell(random);
  CellDescription cell = crossing_description();
  cell.scheduling.on_idle_blocker =
      random.chance(0.5) ? OnIdleBlocker::park : OnIdleBlocker::replan;
  cell.scheduling.backlog_timeout = from_seconds(random.uniform(5.0, 40.0));
  return cell;
}

CellDescription pandas(Random& random) {
  std::ifstream file(source_dir() + "/config/two_pandas.json");
  std::ostringstream text;
  text << file.rdbuf();
  auto cell = read_cell_text(text.str(), source_dir() + "/config");
  if (!cell) throw std::runtime_error(cell.error().front().detail);
  cell->scheduling.on_idle_blocker = std::vector{OnIdleBlocker::report, OnIdleBlocker::park,
                                                 OnIdleBlocker::replan}[random.index(3)];
  cell->scheduling.backlog_timeout = from_seconds(random.uniform(10.0, 100.0));
  return *cell;
}

}  // namespace

CellDescription random_cell(RandomWorld world, Random& random) {
  return world == RandomWorld::sliders ? sliders(random) : pandas(random);
}

RandomJobs::RandomJobs(const Cell& cell, Random& random, std::function<Executive&()> executive,
                       bool only_goals)
    : random_(random), executive_(std::move(executive)), only_goals_(only_goals) {
  for (const armloom::Arm& arm : cell.arms) {
    Arm& own = arms_.emplace_back(Arm{arm.name, {}, {arm.home.begin(), arm.home.end()}, 1.1});
    for (const JointId joint : arm.joints) own.joints.push_back(cell.joint(joint).name);
  }
}

std::vector<double> RandomJobs::anywhere(const Arm& arm) {
  std::vector<double> q = arm.home;
  if (random_.chance(0.15)) return q;
  const bool slides = q.size() == 1;
  for (double& position : q) {
    position =
        slides ? random_.uniform(-1.2, 1.2) : position + random_.uniform(-arm.spread, arm.spread);
  }
  return q;
}

std::vector<double> RandomJobs::predicted(std::size_t arm) {
  const Snapshot now = executive_().snapshot(0);
  std::vector<double> q = now.arms[arm].q;
  for (const JobView& job : now.jobs) {
    const auto known = ends_.find(job.key);
    if (known != ends_.end() && !known->second[arm].empty()) q = known->second[arm];
  }
  return q;
}

std::string RandomJobs::any_job() {
  const Snapshot now = executive_().snapshot(5);
  return now.jobs.empty() ? "" : now.jobs[random_.index(now.jobs.size())].key;
}

std::vector<std::size_t> RandomJobs::some_arms(std::size_t most) {
  std::vector<std::size_t> all;
  for (std::size_t a = 0; a < arms_.size(); ++a) all.push_back(a);
  for (std::size_t a = 0; a < all.size(); ++a) {
    std::swap(all[a], all[a + random_.index(all.size() - a)]);
  }
  all.resize(std::min(most, all.size()));
  return all;
}

JobRequest RandomJobs::motion(const std::vector<std::size_t>& arms) {
  JobRequest request{.key = "", .name = "", .trajectory = {}};
  std::vector<double> from, to;
  for (const std::size_t arm : arms) {
    const auto& joints = arms_[arm].joints;
    request.trajectory.joint_names.insert(request.trajectory.joint_names.end(), joints.begin(),
                                          joints.end());
    std::vector<double> begins = predicted(arm);
    if (random_.chance(0.05)) begins = anywhere(arms_[arm]);
    if (random_.chance(0.1)) begins[0] += random_.uniform(-0.008, 0.008);
    const std::vector<double> ends = anywhere(arms_[arm]);
    from.insert(from.end(), begins.begin(), begins.end());
    to.insert(to.end(), ends.begin(), ends.end());
  }
  double farthest = 0.0;
  for (std::size_t j = 0; j < from.size(); ++j)
    farthest = std::max(farthest, std::abs(to[j] - from[j]));
  const std::vector<double> zero(from.size(), 0.0);
  const double takes_s = random_.uniform(1.1, 3.0) * std::max(0.5, farthest);
  request.trajectory.points = {{from, zero, zero, 0.0}, {to, zero, zero, takes_s}};
  if (random_.chance(0.3)) request.terms.move_to_start = MoveToStart::plan;
  return request;
}

// Returns a motion out and back for either of two arms.
JobRequest RandomJobs::loop() {
  JobRequest request{.key = "", .name = "", .trajectory = {}};
  for (const std::size_t arm : some_arms(2)) {
    JobRequest one = motion({arm});
    auto& points = one.trajectory.points;
    points.push_back(points.front());
    points.back().time_from_start_s = 2 * points[1].time_from_start_s;
    request.alternatives.push_back(std::move(one.trajectory));
  }
  return request;
}

JobRequest RandomJobs::goal() {
  JobRequest request{.key = "", .name = "", .trajectory = {}};
  const std::vector<std::size_t> arms = some_arms(random_.chance(0.25) ? 2 : 1);
  request.move_to = PlanGoal{.joints = anywhere(arms_[arms.front()]), .named = {}, .pose = {}};
  if (arms.size() == 1) {
    request.arm = arms_[arms.front()].name;
  } else {
    for (const std::size_t arm : arms) request.arms.push_back(arms_[arm].name);
  }
  return request;
}

JobRequest RandomJobs::any() {
  const double what = random_.uniform(0.0, 1.0);
  JobRequest request = only_goals_   ? goal()
                       : what < 0.50 ? motion(some_arms(1))
                       : what < 0.60 ? motion(some_arms(2))
                       : what < 0.70 ? loop()
                                     : goal();
  request.key = "s" + std::to_string(next_++);
  if (random_.chance(0.3)) request.terms.priority = static_cast<int>(random_.index(3)) - 1;
  if (random_.chance(0.2)) request.terms.on_timeout = OnTimeout::replan;
  if (random_.chance(0.2)) request.terms.reorderable = true;
  if (random_.chance(0.1)) {
    const std::string before = any_job();
    if (!before.empty()) request.after = {before};
  }
  return request;
}

void RandomJobs::accepted(const std::string& key, const JobRequest& request) {
  auto& ends = ends_[key];
  ends.resize(arms_.size());
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
    if (request.move_to && request.arm == arms_[arm].name) ends[arm] = *request.move_to->joints;
    for (const StepRequest& step : request.steps) {
      const auto* motion = std::get_if<MotionStepRequest>(&step.what);
      if (motion && motion->arm == arms_[arm].name) ends[arm] = *motion->move_to->joints;
    }
    const auto& names = request.trajectory.joint_names;
    const auto first = std::ranges::find(names, arms_[arm].joints.front());
    if (first == names.end()) continue;
    const auto at = request.trajectory.points.back().positions.begin() + (first - names.begin());
    ends[arm].assign(at, at + static_cast<std::ptrdiff_t>(arms_[arm].joints.size()));
  }
}

}  // namespace armloom
