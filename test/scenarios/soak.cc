#include "test/scenarios/soak.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
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

// Counts monitor findings and guard refusals, and records the smallest distance.
struct Soak::Watch final : Observer {
  void on_event(const Event& event) override {
    if (std::holds_alternative<MonitorEvent>(event.body)) ++monitor;
    if (const auto* guard = std::get_if<GuardEvent>(&event.body)) {
      ++refusals;
      if (first.empty()) {
        first = std::to_string(to_seconds(event.time)) + " s: " + to_string(guard->refusal.why) +
                " " + guard->arm + " " + guard->job + " beside " + guard->other_arm + " " +
                guard->other_job;
      }
    }
  }
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame& frame) override {
    for (const Proximity& pair : frame.clearance) {
      if (pair.arm_b) closest_m = std::min(closest_m, pair.clearance_m);
    }
  }
  std::uint64_t monitor = 0, refusals = 0;
  double closest_m = 1e9;
  std::string first;
};

Soak::Soak(std::uint64_t seed, World world, const std::string& policy, bool slows)
    : random_(seed),
      random_speed_(seed + 1),
      slows_(slows),
      policy_(policy),
      watch_(std::make_unique<Watch>()) {
  const CellDescription description = world == World::sliders ? sliders(random_) : pandas(random_);
  auto cell = build_cell(description);
  if (!cell) throw std::runtime_error(cell.error().front().detail);
  cell_ = *cell;
  for (const armloom::Arm& arm : cell_->arms) {
    Arm& own = arms_.emplace_back(Arm{arm.name, {}, {arm.home.begin(), arm.home.end()}, 1.1});
    for (const JointId joint : arm.joints) own.joints.push_back(cell_->joint(joint).name);
  }
  may_fault_ = random_.chance(0.25);
  may_see_objects_ = random_.chance(0.25);
  start(1, {});
}

Soak::~Soak() = default;

void Soak::start(std::uint64_t first_job, std::vector<RestoredJob> left) {
  auto created = Simulation::create(
      cell_, ExecutiveOptions{.policy = policy_, .first_job = JobId{first_job}}, *watch_);
  if (!created) throw std::runtime_error(created.error().front().detail);
  simulation_ = std::move(*created);
  (void)executive().restore(std::move(left));
  simulation_->tick();
}

// ---- Jobs ----

std::vector<double> Soak::anywhere(const Arm& arm) {
  std::vector<double> q = arm.home;
  if (random_.chance(0.15)) return q;
  const bool slides = q.size() == 1;
  for (double& position : q) {
    position =
        slides ? random_.uniform(-1.2, 1.2) : position + random_.uniform(-arm.spread, arm.spread);
  }
  return q;
}

std::vector<double> Soak::predicted(std::size_t arm) {
  const Snapshot now = executive().snapshot(0);
  std::vector<double> q = now.arms[arm].q;
  for (const JobView& job : now.jobs) {
    const auto known = ends_.find(job.key);
    if (known != ends_.end() && !known->second[arm].empty()) q = known->second[arm];
  }
  return q;
}

std::string Soak::any_job() {
  const Snapshot now = executive().snapshot(5);
  return now.jobs.empty() ? "" : now.jobs[random_.index(now.jobs.size())].key;
}

std::vector<std::size_t> Soak::some_arms(std::size_t most) {
  std::vector<std::size_t> all;
  for (std::size_t a = 0; a < arms_.size(); ++a) all.push_back(a);
  for (std::size_t a = 0; a < all.size(); ++a) {
    std::swap(all[a], all[a + random_.index(all.size() - a)]);
  }
  all.resize(std::min(most, all.size()));
  return all;
}

JobRequest Soak::motion(const std::vector<std::size_t>& arms) {
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
JobRequest Soak::loop() {
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

JobRequest Soak::goal() {
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

JobRequest Soak::any_request() {
  const double what = random_.uniform(0.0, 1.0);
  JobRequest request = what < 0.50   ? motion(some_arms(1))
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

void Soak::submit(JobRequest request) {
  const JobRequest copy = request;
  note(executive().submit(std::move(request)), copy);
}

void Soak::note(const Result<JobView>& accepted, const JobRequest& request) {
  if (!accepted) return;
  ++tally_->jobs;
  requests_[accepted->key] = request;
  auto& ends = ends_[accepted->key];
  ends.resize(arms_.size());
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
    if (request.move_to && request.arm == arms_[arm].name) ends[arm] = *request.move_to->joints;
    const auto& names = request.trajectory.joint_names;
    const auto first = std::ranges::find(names, arms_[arm].joints.front());
    if (first == names.end()) continue;
    const auto at = request.trajectory.points.back().positions.begin() + (first - names.begin());
    ends[arm].assign(at, at + static_cast<std::ptrdiff_t>(arms_[arm].joints.size()));
  }
}

// ---- Commands ----

void Soak::command() {
  ++tally_->commands;
  const std::size_t what = random_.index(100);
  const ArmId arm{static_cast<std::uint32_t>(random_.index(arms_.size()))};
  if (what < 52) return submit(any_request());
  if (what < 56) {
    std::vector<JobRequest> jobs{any_request(), any_request()};
    const std::vector<JobRequest> copy = jobs;
    const auto answers = submit_batch(executive(), std::move(jobs), random_.chance(0.5));
    for (std::size_t i = 0; answers && i < copy.size(); ++i) note((*answers)[i], copy[i]);
  } else if (what < 66) {
    (void)executive().cancel(any_job());
  } else if (what < 71) {
    (void)executive().replan(any_job());
  } else if (what < 75) {
    (void)executive().amend(
        any_job(), {.terms = {.priority = static_cast<int>(random_.index(5)) - 2,
                              .backlog_timeout = from_seconds(random_.uniform(1.0, 60.0))}});
  } else if (what < 79) {
    random_.chance(0.4) ? stop_all(executive(), "soak") : executive().stop({arm}, "soak");
  } else if (what < 91) {
    random_.chance(0.6) ? resume_all(executive()) : executive().resume({arm});
  } else if (what < 94) {
    change_scene();
  } else if (what < 97) {
    inject();
  } else if (what < 99) {
    (void)executive().policy().change(
        std::vector<std::string>{"certified", "earliest_start", "coordinated", "reservation",
                                 "lockstep", "sequential"}[random_.index(6)]);
  } else {
    restart();
  }
}

void Soak::change_speed() {
  const std::size_t which = random_speed_.index(arms_.size() + 1);
  const std::vector<double> shares{0.0, 0.05, 0.3, 0.7, 1.0, 1.0};
  executive().set_speed(which == arms_.size()
                            ? std::nullopt
                            : std::optional(ArmId{static_cast<std::uint32_t>(which)}),
                        shares[random_speed_.index(shares.size())]);
}

void Soak::change_scene() {
  if (!may_see_objects_) return;
  disturbed_ = true;
  CollisionObject ball{.name = "ball", .shape = Sphere{0.05}};
  for (int axis = 0; axis < 3; ++axis) ball.X_WO.translation()[axis] = random_.uniform(-0.8, 0.8);
  if (arms_.front().joints.size() == 1) ball.X_WO.translation().z() = 0.0;
  LiveScene& scene = executive().scene();
  const bool is_there = std::ranges::any_of(
      scene.objects(), [](const CollisionObject& object) { return object.name == "ball"; });
  (void)(!is_there             ? scene.add(ball)
         : random_.chance(0.5) ? scene.replace(ball)
                               : scene.remove("ball"));
}

void Soak::inject() {
  if (!may_fault_) return;
  disturbed_ = true;
  const std::vector<ArmFault::Kind> kinds{ArmFault::Kind::stall, ArmFault::Kind::slow,
                                          ArmFault::Kind::late_start, ArmFault::Kind::drop_feedback,
                                          ArmFault::Kind::fault};
  (void)executive().faults().inject({.arm = arms_[random_.index(arms_.size())].name,
                                     .kind = kinds[random_.index(kinds.size())],
                                     .lasting = from_seconds(random_.uniform(0.1, 3.0)),
                                     .value = random_.uniform(0.1, 1.0)});
}

// Restarts the server: the arms are at home, and waiting jobs are restored.
void Soak::restart() {
  ++tally_->restarts;
  bool done = false;
  executive().wind_down("restart", Executive::Waiting::is_kept, [&done] { done = true; });
  const TimePoint latest = simulation_->now() + 30s;
  while (!done && simulation_->now() < latest) simulation_->tick();
  std::vector<RestoredJob> left;
  std::uint64_t first = 1;
  const Snapshot last = executive().snapshot();
  for (const JobView& job : last.jobs) {
    first = std::max(first, job.id.value() + 1);
    const auto request = requests_.find(job.key);
    if (is_terminal(job.state) || request == requests_.end()) continue;
    JobRequest again = request->second;
    again.key = job.key;
    again.after.clear();
    left.push_back({job.id, std::move(again), TimePoint(-1s)});
  }
  tally_->hours += to_seconds(simulation_->now()) / 3600;
  start(first, std::move(left));
}

// Resumes everything until all jobs have ended or the cell is settled.
void Soak::settle() {
  (void)executive().scene().remove("ball");
  resume_all(executive());
  executive().set_speed(std::nullopt, 1.0);
  for (std::uint32_t arm = 0; arm < arms_.size(); ++arm) executive().set_speed(ArmId{arm}, 1.0);
  const TimePoint latest = simulation_->now() + 3600s;
  while (!executive().all_ended() && !simulation_->settled() && simulation_->now() < latest) {
    simulation_->pass_over_rest(latest);
    simulation_->tick();
    const auto stopped = executive().arms();
    const bool any = std::ranges::any_of(
        stopped, [](const ArmView& arm) { return arm.state == ArmState::stopped; });
    if (any) resume_all(executive());
  }
}

void Soak::run(SoakTally& tally, bool expects) {
  tally_ = &tally;
  const std::size_t commands = 30 + random_.index(60);
  for (std::size_t i = 0; i < commands; ++i) {
    command();
    if (slows_ && random_speed_.chance(0.4)) change_speed();
    simulation_->run_until(simulation_->now() + from_seconds(random_.uniform(0.0, 1.5)));
  }
  settle();
  ++tally.runs;
  tally.hours += to_seconds(simulation_->now()) / 3600;
  tally.guard_refusals += watch_->refusals;
  for (const JobView& job : executive().snapshot().jobs) {
    tally.succeeded += job.state == JobState::succeeded ? 1 : 0;
    tally.own += job.system_job ? 1 : 0;
  }
  const bool hangs = !executive().all_ended();
  tally.hung += hangs ? 1 : 0;
  // Certified motions keep the clearance, except for rounding.
  const double kept_m = 0.99 * cell_->clearances.clearance_m;
  if (!disturbed_) {
    tally.monitor_findings += watch_->monitor;
    tally.closest_m = std::min(tally.closest_m, watch_->closest_m);
    tally.too_close += watch_->closest_m < kept_m ? 1 : 0;
  }
  if (!expects) return;
  EXPECT_EQ(watch_->refusals, 0U) << watch_->first;
  if (!disturbed_) {
    EXPECT_EQ(watch_->monitor, 0U);
    EXPECT_GE(watch_->closest_m, kept_m);
  }
  EXPECT_FALSE(hangs);
  if (!hangs) return;
  for (const JobView& job : executive().snapshot(0).jobs) std::cout << told(job) << "\n";
}

}  // namespace armloom
