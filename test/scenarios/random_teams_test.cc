// Jobs of one, two or three arms at once in cells of three and four arms, with random delays,
// commands and faults: nothing touches, every job reaches exactly one end, and who waits for ever
// waits for an arm that nobody moves. The measured distance is known at every tick.
// ARMLOOM_SEEDS=500 runs more; ARMLOOM_TOLD=<seed> runs that one alone and tells its story.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <set>

#include "test/scenarios/polygon.h"
#include "test/scenarios/random_faults.h"
#include "test/scenarios/seeds.h"
#include "test/scenarios/star.h"

namespace armloom {
namespace {

constexpr std::uint64_t kSeeds = 80;           // of the policy that coordinates
constexpr std::uint64_t kSeedsOfOthers = 25;   // of each other one
constexpr double kHoldsUnderDelays_m = 0.015;  // the cell's clearance less what tracking costs
constexpr Duration kQuiet = 45s;               // nothing happens for so long: nothing ever will

// One arm along x that crosses two others, and with four arms a second one beside it.
CellDescription ladder(std::size_t arms) {
  CellDescription cell = star(arms);
  const auto turn = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
  for (std::size_t i = 0; i < arms; ++i) {
    Eigen::Isometry3d& X_WB = cell.robots[i].X_WB;
    const bool rung = i == 1 || i == 2;
    X_WB.linear() = rung ? turn.toRotationMatrix() : Eigen::Matrix3d::Identity().eval();
    X_WB.translation() = Eigen::Vector3d(0, i == 3 ? 0.6 : 0, 0);
    if (rung) X_WB.translation().x() = i == 1 ? -0.5 : 0.5;
  }
  return cell;
}

CellDescription world(Random& random) {
  const std::size_t arms = random.chance(0.6) ? 3 : 4;
  CellDescription cell;
  switch (random.index(3)) {
    case 0:
      cell = star(arms);
      break;
    case 1:
      cell = polygon(static_cast<int>(arms));
      cell.robots.pop_back();
      break;
    default:
      cell = ladder(arms);
  }
  if (random.chance(0.5)) {
    cell.scheduling.on_idle_blocker = OnIdleBlocker::park;
    for (RobotDescription& robot : cell.robots) {
      robot.srdf = ARMLOOM_SOURCE_DIR "/test/scenarios/data/slider_with_back.srdf";
    }
  }
  cell.scheduling.backlog_timeout = from_seconds(random.uniform(5.0, 40.0));
  if (random.chance(0.3)) cell.scheduling.aging = 3s;
  cell.checking.time_step = 50ms;
  return cell;
}

// Everything that is told, and how near the balls have come.
struct Watched final : Observer {
  explicit Watched(const CellDescription& cell) {
    for (const RobotDescription& robot : cell.robots) X_WB.push_back(robot.X_WB);
    for (const RobotDescription& robot : cell.robots) names.push_back(robot.name);
    in_step.assign(names.size(), std::vector<bool>(names.size(), false));
  }
  void on_event(const Event& event) override {
    events.push_back(event);
    const auto* job = std::get_if<JobView>(&event.body);
    if (job == nullptr || job->state != JobState::running) return;
    const auto takes_part = [&](std::size_t arm) {
      return std::ranges::find(job->arms, names[arm]) != job->arms.end();
    };
    for (std::size_t i = 0; i < names.size(); ++i) {
      for (std::size_t j = 0; j < names.size(); ++j) {
        if (takes_part(i) || takes_part(j)) in_step[i][j] = takes_part(i) && takes_part(j);
      }
    }
  }
  void on_state(const StateFrame&) override {}
  void on_tick(TimePoint now, const Configuration& measured) override {
    if (last.size() == 0 || (measured - last).cwiseAbs().maxCoeff() > 1e-9) moved_at = now;
    last = measured;
    for (std::size_t i = 0; i < X_WB.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double apart_m = (center(i) - center(j)).norm() - 0.2;
        if (in_step[i][j]) {
          if (apart_m < smallest_in_step_m) smallest_in_step_m = apart_m, when_in_step = now;
        } else if (apart_m < smallest_m) {
          smallest_m = apart_m, when = now;
        }
      }
    }
  }
  [[nodiscard]] Eigen::Vector3d center(std::size_t arm) const {
    return X_WB[arm] * Eigen::Vector3d(last[static_cast<Eigen::Index>(arm)], 0, 0);
  }

  std::vector<Eigen::Isometry3d> X_WB;
  std::vector<std::string> names;
  std::vector<std::vector<bool>> in_step;  // the last motion of both was the same
  std::vector<Event> events;
  Configuration last;
  double smallest_m = 1e9, smallest_in_step_m = 1e9;
  TimePoint when{}, when_in_step{}, moved_at{};
};

struct Tally {
  std::size_t jobs = 0, succeeded = 0, own = 0;
  double smallest_m = 1e9;          // where no controller gave up
  double smallest_fault_m = 1e9;    // where one did
  double smallest_in_step_m = 1e9;  // of two arms of one motion
  std::uint64_t monitor_stops = 0;
};

class TeamsRun {
 public:
  TeamsRun(std::uint64_t seed, const std::string& policy)
      : random_(seed), description_(world(random_)), watched_(description_) {
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

  void run(Tally& tally) {
    const std::size_t commands = 10 + random_.index(16);
    for (std::size_t i = 0; i < commands; ++i) {
      command();
      simulation_->run_until(simulation_->now() + from_seconds(random_.uniform(0.0, 1.2)));
      note_own_jobs();
    }
    settle();
    if (!executive().all_ended()) explain_what_waits();
    if (told()) tell();
    end_all();
    judge(tally);
  }

 private:
  Executive& executive() { return simulation_->executive(); }
  static bool told() { return std::getenv("ARMLOOM_TOLD") != nullptr; }

  ArmId any_arm() { return ArmId{static_cast<std::uint32_t>(random_.index(arms_.size()))}; }

  // Of one to three arms, from where clients' jobs leave them.
  JobRequest random_job() {
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
    if (random_.chance(0.4)) request.priority = static_cast<int>(random_.index(3)) - 1;
    if (!now.jobs.empty() && random_.chance(0.12)) {
      request.after = {now.jobs[random_.index(now.jobs.size())].key};
    }
    return request;
  }

  double predicted(const Snapshot& now, std::size_t arm) {
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

  void remember(const Result<JobView>& accepted, const JobRequest& request) {
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
              << request.priority;
    for (const std::string& key : request.after) std::cout << ", after " << key;
    for (std::size_t j = 0; j < request.trajectory.joint_names.size(); ++j) {
      std::cout << "; " << request.trajectory.joint_names[j] << " "
                << request.trajectory.points.front().positions[j] << " to "
                << request.trajectory.points.back().positions[j];
    }
    std::cout << " in " << request.trajectory.points.back().time_from_start_s << " s\n";
  }

  void say(const std::string& what) {
    if (told()) std::cout << to_seconds(simulation_->now()) << " s: " << what << "\n";
  }

  void submit() {
    const JobRequest request = random_job();
    remember(executive().submit(request), request);
  }

  void batch() {
    // Of different arms, or the second one may not begin where the first one ends.
    std::vector<JobRequest> jobs = {random_job(), random_job()};
    const auto answers = executive().submit_batch(jobs, random_.chance(0.5));
    if (!answers) return;
    for (std::size_t i = 0; i < jobs.size(); ++i) remember((*answers)[i], jobs[i]);
  }

  void command() {
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
        return executive().resume({arm});
      case 17:
        say("resume all");
        return executive().resume_all();
      case 18:
        if (may_see_objects_) change_scene();
        return;
      default:
        return inject(name);
    }
  }

  void cancel(const std::string& key) {
    say("cancel " + key);
    static_cast<void>(executive().cancel(key));
  }

  void change_scene() {
    say("scene");
    CollisionObject ball{.name = "ball", .shape = Sphere{0.05}};
    ball.X_WO.translation().x() = random_.uniform(-1.0, 1.0);
    if (executive().objects().empty()) {
      static_cast<void>(executive().add_object(ball));
    } else if (random_.chance(0.5)) {
      static_cast<void>(executive().replace_object(ball));
    } else {
      static_cast<void>(executive().remove_object("ball"));
    }
  }

  void inject(const std::string& arm) {
    const bool fault = may_fault_ && random_.chance(0.5);
    faulted_ = faulted_ || fault;
    say((fault ? "fault " : "stall ") + arm);
    static_cast<void>(
        executive().inject({.arm = arm,
                            .kind = fault ? ArmFault::Kind::fault : ArmFault::Kind::stall,
                            .lasting = from_seconds(random_.uniform(0.1, 3.0))}));
  }

  void note_own_jobs() {
    for (; read_ < watched_.events.size(); ++read_) {
      const auto* job = std::get_if<JobView>(&watched_.events[read_].body);
      if (job == nullptr || !job->key.starts_with("aside-")) continue;
      if (own_.insert(job->key).second) keys_.push_back(job->key);
    }
  }

  // Everything may go on, until nothing has happened for long.
  void settle() {
    const TimePoint limit = simulation_->now() + 900s;
    if (!executive().objects().empty()) static_cast<void>(executive().remove_object("ball"));
    executive().resume_all();
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
        if (stopped_in_vain()) executive().resume_all();
        resumed_at = simulation_->now();
      }
      if (simulation_->now() > std::max(changed_at, watched_.moved_at) + kQuiet) break;
    }
    EXPECT_LT(simulation_->now(), limit) << "never comes to an end";
    note_own_jobs();
  }

  // By the monitor, or by a controller that gave up.
  bool stopped_in_vain() {
    const Snapshot now = executive().snapshot(0);
    return std::ranges::any_of(now.jobs, [](const JobView& job) {
      return std::ranges::any_of(
          job.waits_on, [](const WaitView& wait) { return wait.kind == Wait::Kind::stop; });
    });
  }

  // An arm rests for ever in the way of each.
  void explain_what_waits() {
    const Snapshot now = executive().snapshot();
    std::map<std::string, std::set<std::string>> waits;  // of jobs, and of "arm:" with a job
    std::set<std::string> explained;
    for (const JobView& job : now.jobs) {
      if (is_terminal(job.state)) continue;
      for (const std::string& arm : job.arms) {
        auto& of_arm = waits["arm:" + arm];
        const bool behind = job.state == JobState::scheduled && job.waits_on.empty();
        if (behind) waits[job.key].insert(of_arm.begin(), of_arm.end());  // is not told
        of_arm.insert(job.key);
      }
      for (const WaitView& wait : job.waits_on) {
        waits[job.key].insert(wait.kind == Wait::Kind::arm ? "arm:" + wait.arm : wait.job);
      }
    }
    for (const std::string& arm : arms_) {
      if (!waits.contains("arm:" + arm)) explained.insert("arm:" + arm);
    }
    for (bool more = true; more;) {
      more = false;
      for (const auto& [waiter, causes] : waits) {
        const bool is = std::ranges::any_of(
            causes, [&](const std::string& cause) { return explained.contains(cause); });
        if (is) more = explained.insert(waiter).second || more;
      }
    }
    for (const JobView& job : now.jobs) {
      if (is_terminal(job.state)) continue;
      EXPECT_TRUE(explained.contains(job.key)) << "hangs: " << armloom::told(job);
    }
  }

  // What is left is canceled. An arm may be sent aside or back even then.
  void end_all() {
    for (int turn = 0; turn < 4 && !executive().all_ended(); ++turn) {
      for (const std::string& key : keys_) static_cast<void>(executive().cancel(key));
      simulation_->run_until(simulation_->now() + 8s);
      note_own_jobs();
    }
    EXPECT_TRUE(executive().all_ended()) << "jobs outlive their cancel";
  }

  void judge(Tally& tally) {
    std::map<std::string, int> endings;
    for (const Event& event : watched_.events) {
      const auto* job = std::get_if<JobView>(&event.body);
      if (job == nullptr || !is_terminal(job->state)) continue;
      ++endings[job->key];
      if (job->state == JobState::succeeded) ++tally.succeeded;
    }
    for (const std::string& key : keys_) EXPECT_EQ(endings[key], 1) << key;
    for (const ArmView& arm : executive().arms()) EXPECT_EQ(arm.job, "");
    EXPECT_LE(own_.size(), 8 * (keys_.size() - own_.size() + 1)) << "arms go to and fro";
    const auto& figures = executive().figures();
    EXPECT_GT(watched_.smallest_m, 0.0) << "contact at " << to_seconds(watched_.when) << " s";
    if (!faulted_) {
      EXPECT_GT(watched_.smallest_m, kHoldsUnderDelays_m)
          << "at " << to_seconds(watched_.when) << " s";
      const bool out_of_step = watched_.smallest_in_step_m < kHoldsUnderDelays_m;
      EXPECT_EQ(may_see_objects_ || out_of_step ? 0U : figures.monitor_stops, 0U);
    }
    EXPECT_GT(watched_.smallest_in_step_m, 0.0)
        << "out of step at " << to_seconds(watched_.when_in_step) << " s";
    tally.smallest_in_step_m = std::min(tally.smallest_in_step_m, watched_.smallest_in_step_m);
    double& smallest_m = faulted_ ? tally.smallest_fault_m : tally.smallest_m;
    smallest_m = std::min(smallest_m, watched_.smallest_m);
    tally.jobs += keys_.size();
    tally.own += own_.size();
    tally.monitor_stops += figures.monitor_stops;
  }

  void tell() {
    std::cout << description_.name << " of " << arms_.size() << ", closest " << watched_.smallest_m
              << " at " << to_seconds(watched_.when) << " s\n";
    for (const Event& event : watched_.events) {
      const double time_s = to_seconds(event.time);
      if (const auto* job = std::get_if<JobView>(&event.body)) {
        std::cout << time_s << " s: " << armloom::told(*job) << " at "
                  << job->progress * to_seconds(job->duration) << "\n";
      } else if (const auto* alert = std::get_if<Alert>(&event.body)) {
        std::cout << time_s << " s: " << alert->text << "\n";
      } else if (const auto* found = std::get_if<MonitorEvent>(&event.body)) {
        std::cout << time_s << " s: monitor, stops";
        for (const std::string& arm : found->stopped) std::cout << " " << arm;
        std::cout << "\n";
      }
    }
  }

  Random random_;
  CellDescription description_;
  Watched watched_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::string> arms_;
  std::vector<double> left_;       // by clients' jobs
  std::vector<std::string> keys_;  // the server's own included
  std::set<std::string> own_;
  std::map<std::pair<std::string, std::string>, double> goals_;  // of job and arm
  std::size_t read_ = 0;
  bool delayed_ = false, commanded_ = false, may_fault_ = false, may_see_objects_ = false;
  bool faulted_ = false;
};

class RandomTeams : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Policies, RandomTeams,
                         ::testing::Values("coordinated", "earliest_start", "certified",
                                           "reservation", "lockstep", "sequential"));

TEST_P(RandomTeams, TouchNobodyAndEveryJobComesToOneEnd) {
  const std::string policy = GetParam();
  Tally tally;
  std::uint64_t first = 1, last = seed_count(policy == "coordinated" ? kSeeds : kSeedsOfOthers);
  if (const char* only = std::getenv("ARMLOOM_TOLD"))
    first = last = std::strtoull(only, nullptr, 10);
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    SCOPED_TRACE(policy + ", seed " + std::to_string(seed));
    TeamsRun(seed, policy).run(tally);
  }
  std::cout << policy << ": " << last + 1 - first << " seeds, " << tally.jobs << " jobs, "
            << tally.own << " of them the server's own, " << tally.succeeded
            << " succeeded, closest " << tally.smallest_m << " m, with arms that gave up "
            << tally.smallest_fault_m << " m, in step " << tally.smallest_in_step_m << " m, "
            << tally.monitor_stops << " monitor stops\n";
}

}  // namespace
}  // namespace armloom
