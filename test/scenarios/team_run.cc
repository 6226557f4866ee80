#include "test/scenarios/team_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "core/model/cell/build_cell.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
constexpr Duration kQuiet = 45s;  // without events or motion for this long, the world is settled

}  // namespace

TeamsRun::TeamsRun(std::uint64_t seed, const std::string& policy)
    : random_(seed), description_(team_cell(random_)), watched_(description_) {
  auto cell = build_cell(description_);
  if (!cell) throw std::runtime_error(cell.error().front().detail);
  auto created = Simulation::create(*cell, ExecutiveOptions{.policy = policy}, watched_);
  if (!created) throw std::runtime_error(created.error().front().detail);
  simulation_ = std::move(*created);
  simulation_->tick();
  for (const RobotDescription& robot : description_.robots) arms_.push_back(robot.name);
  left_.assign(arms_.size(), -1.0);
  delayed_ = random_.chance(0.6);
  commanded_ = random_.chance(0.6);
  may_fault_ = commanded_ && random_.chance(0.3);
  may_see_objects_ = commanded_ && random_.chance(0.3);
  for (const std::string& arm : arms_) {
    if (delayed_) delay_at_random(executive(), arm, 30.0, random_);
  }
}

void TeamsRun::run(TeamTally& tally) {
  const std::size_t commands = 10 + random_.index(16);
  for (std::size_t i = 0; i < commands; ++i) {
    command();
    simulation_->run_until(simulation_->now() + from_seconds(random_.uniform(0.0, 1.2)));
    note_own_jobs();
    compare();
  }
  settle();
  if (!executive().all_ended()) explain_what_waits();
  if (told()) tell();
  end_all();
  judge(tally);
}

JobRequest TeamsRun::random_job() {
  const Snapshot now = executive().snapshot();
  std::vector<std::size_t> order(arms_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::swap(order[i], order[i + random_.index(order.size() - i)]);
  }
  const double share = random_.uniform(0.0, 1.0);
  order.resize(share < 0.55 ? 1 : share < 0.85 ? 2 : 3);
  JobRequest request;
  std::vector<double> from, to;
  double farthest_m = 0.0;
  for (const std::size_t arm : order) {
    request.trajectory.joint_names.push_back(arms_[arm] + "_slide");
    from.push_back(predicted(now, arm));
    const double side = from.back() < 0 ? 1.0 : -1.0;
    const bool across = random_.chance(0.6);
    to.push_back(across ? side * random_.uniform(0.7, 1.2) : random_.uniform(-1.2, 1.2));
    farthest_m = std::max(farthest_m, std::abs(to.back() - from.back()));
  }
  const std::vector<double> zero(from.size(), 0.0);
  const double duration_s = std::max(random_.uniform(0.8, 5.0), farthest_m * 1.05);
  request.trajectory.points = {{from, zero, zero, 0.0}, {to, zero, zero, duration_s}};
  if (random_.chance(0.4)) request.terms.priority = static_cast<int>(random_.index(3)) - 1;
  if (!now.jobs.empty() && random_.chance(0.12)) {
    request.after = {now.jobs[random_.index(now.jobs.size())].key};
  }
  return request;
}

double TeamsRun::predicted(const Snapshot& now, std::size_t arm) {
  double q = now.arms[arm].q.front();
  for (const JobView& job : now.jobs) {
    const bool of_this = std::ranges::find(job.arms, arms_[arm]) != job.arms.end();
    if (of_this && !is_terminal(job.state) && own_.contains(job.key)) q = left_[arm];
  }
  for (const JobView& job : now.jobs) {
    const auto goal = goals_.find({job.key, arms_[arm]});
    if (!is_terminal(job.state) && goal != goals_.end()) q = goal->second;
  }
  return left_[arm] = q;
}

void TeamsRun::remember(const Result<JobView>& accepted, const JobRequest& request) {
  if (told() && !accepted) std::cout << "refused: " << accepted.error().front().detail << "\n";
  if (!accepted) return;
  keys_.push_back(accepted->key);
  for (std::size_t j = 0; j < request.trajectory.joint_names.size(); ++j) {
    const std::string& joint = request.trajectory.joint_names[j];
    goals_[{accepted->key, joint.substr(0, joint.find('_'))}] =
        request.trajectory.points.back().positions[j];
  }
  if (!told()) return;
  std::cout << to_seconds(simulation_->now()) << " s: " << accepted->key << ", priority "
            << request.terms.priority;
  for (const std::string& key : request.after) std::cout << ", after " << key;
  for (std::size_t j = 0; j < request.trajectory.joint_names.size(); ++j) {
    std::cout << "; " << request.trajectory.joint_names[j] << " "
              << request.trajectory.points.front().positions[j] << " to "
              << request.trajectory.points.back().positions[j];
  }
  std::cout << " in " << request.trajectory.points.back().time_from_start_s << " s\n";
}

void TeamsRun::say(const std::string& what) {
  if (told()) std::cout << to_seconds(simulation_->now()) << " s: " << what << "\n";
}

void TeamsRun::submit() {
  const JobRequest request = random_job();
  remember(executive().submit(request), request);
}

void TeamsRun::batch() {
  // The two jobs may have an arm in common. Then the second may not start where the first ends.
  std::vector<JobRequest> jobs = {random_job(), random_job()};
  const auto answers = submit_batch(executive(), jobs, random_.chance(0.5));
  if (!answers) return;
  for (std::size_t i = 0; i < jobs.size(); ++i) remember((*answers)[i], jobs[i]);
}

void TeamsRun::command() {
  const std::size_t which = random_.index(20);
  if (which < 11 || !commanded_) return submit();
  const ArmId arm = any_arm();
  const std::string& name = arms_[arm.index()];
  switch (which) {
    case 11:
      return batch();
    case 12:
    case 13:
      if (keys_.empty()) return;
      return cancel(keys_[random_.index(keys_.size())]);
    case 14:
      say("stop " + name);
      return executive().stop({arm}, "random");
    case 15:
    case 16:
      say("resume " + name);
      return static_cast<void>(executive().resume({arm}));
    case 17:
      say("resume all");
      return static_cast<void>(resume_all(executive()));
    case 18:
      if (may_see_objects_) change_scene();
      return;
    default:
      return inject(name);
  }
}

void TeamsRun::cancel(const std::string& key) {
  say("cancel " + key);
  static_cast<void>(executive().cancel(key));
}

void TeamsRun::change_scene() {
  say("scene");
  CollisionObject ball{.name = "ball", .shape = Sphere{0.05}};
  ball.X_WO.translation().x() = random_.uniform(-1.0, 1.0);
  if (executive().scene().objects().empty()) {
    static_cast<void>(executive().scene().add(ball));
  } else if (random_.chance(0.5)) {
    static_cast<void>(executive().scene().replace(ball));
  } else {
    static_cast<void>(executive().scene().remove("ball"));
  }
}

void TeamsRun::inject(const std::string& arm) {
  const bool fault = may_fault_ && random_.chance(0.5);
  faulted_ = faulted_ || fault;
  say((fault ? "fault " : "stall ") + arm);
  static_cast<void>(
      executive().faults().inject({.arm = arm,
                                   .kind = fault ? ArmFault::Kind::fault : ArmFault::Kind::stall,
                                   .lasting = from_seconds(random_.uniform(0.1, 3.0))}));
}

void TeamsRun::note_own_jobs() {
  for (; read_ < watched_.events.size(); ++read_) {
    const auto* job = std::get_if<JobView>(&watched_.events[read_].body);
    if (job == nullptr) continue;
    told_[job->key] = *job;
    if (!job->key.starts_with("retreat-")) continue;
    if (own_.insert(job->key).second) keys_.push_back(job->key);
  }
}

void TeamsRun::settle() {
  const TimePoint limit = simulation_->now() + 900s;
  if (!executive().scene().objects().empty()) static_cast<void>(executive().scene().remove("ball"));
  resume_all(executive());
  say("all may go on");
  std::size_t events = 0;
  const TimePoint begun_at = simulation_->now();
  TimePoint changed_at = begun_at, resumed_at = begun_at;
  while (!executive().all_ended() && simulation_->now() < limit) {
    simulation_->tick();
    if (watched_.events.size() != events) {
      events = watched_.events.size();
      changed_at = simulation_->now();
    }
    if (simulation_->now() > resumed_at + 1s) {
      if (stopped_in_vain()) resume_all(executive());
      resumed_at = simulation_->now();
    }
    if (simulation_->now() > std::max(changed_at, watched_.moved_at) + kQuiet) break;
  }
  EXPECT_LT(simulation_->now(), limit) << "never comes to an end";
  note_own_jobs();
}

bool TeamsRun::stopped_in_vain() {
  const Snapshot now = executive().snapshot(0);
  return std::ranges::any_of(now.jobs, [](const JobView& job) {
    return std::ranges::any_of(job.waits_on,
                               [](const WaitView& wait) { return wait.kind == Wait::Kind::stop; });
  });
}

}  // namespace armloom
