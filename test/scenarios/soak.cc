#include "test/scenarios/soak.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "core/model/cell/build_cell.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

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

Soak::Soak(std::uint64_t seed, RandomWorld world, const std::string& policy, bool slows)
    : random_(seed),
      random_speed_(seed + 1),
      slows_(slows),
      policy_(policy),
      watch_(std::make_unique<Watch>()) {
  auto cell = build_cell(random_cell(world, random_));
  if (!cell) throw std::runtime_error(cell.error().front().detail);
  cell_ = *cell;
  jobs_ =
      std::make_unique<RandomJobs>(*cell_, random_, [this]() -> Executive& { return executive(); });
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

void Soak::submit(JobRequest request) {
  const JobRequest copy = request;
  note(executive().submit(std::move(request)), copy);
}

void Soak::note(const Result<JobView>& accepted, const JobRequest& request) {
  if (!accepted) return;
  ++tally_->jobs;
  requests_[accepted->key] = request;
  jobs_->accepted(accepted->key, request);
}

// ---- Commands ----

void Soak::command() {
  ++tally_->commands;
  const std::size_t what = random_.index(100);
  const ArmId arm{static_cast<std::uint32_t>(random_.index(jobs_->arms().size()))};
  if (what < 52) return submit(jobs_->any());
  if (what < 56) {
    std::vector<JobRequest> jobs{jobs_->any(), jobs_->any()};
    const std::vector<JobRequest> copy = jobs;
    const auto answers = submit_batch(executive(), std::move(jobs), random_.chance(0.5));
    for (std::size_t i = 0; answers && i < copy.size(); ++i) note((*answers)[i], copy[i]);
  } else if (what < 66) {
    (void)executive().cancel(jobs_->any_job());
  } else if (what < 71) {
    (void)executive().replan(jobs_->any_job());
  } else if (what < 75) {
    (void)executive().amend(
        jobs_->any_job(), {.terms = {.priority = static_cast<int>(random_.index(5)) - 2,
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
  const std::size_t which = random_speed_.index(cell_->arms.size() + 1);
  const std::vector<double> shares{0.0, 0.05, 0.3, 0.7, 1.0, 1.0};
  executive().set_speed(which == cell_->arms.size()
                            ? std::nullopt
                            : std::optional(ArmId{static_cast<std::uint32_t>(which)}),
                        shares[random_speed_.index(shares.size())]);
}

void Soak::change_scene() {
  if (!may_see_objects_) return;
  disturbed_ = true;
  CollisionObject ball{.name = "ball", .shape = Sphere{0.05}};
  for (int axis = 0; axis < 3; ++axis) ball.X_WO.translation()[axis] = random_.uniform(-0.8, 0.8);
  if (jobs_->arms().front().joints.size() == 1) ball.X_WO.translation().z() = 0.0;
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
  (void)executive().faults().inject({.arm = jobs_->arms()[random_.index(jobs_->arms().size())].name,
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
  for (std::uint32_t arm = 0; arm < cell_->arms.size(); ++arm)
    executive().set_speed(ArmId{arm}, 1.0);
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
