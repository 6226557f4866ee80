#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "test/scenarios/polygon.h"

namespace armloom::random_commands {

inline constexpr int kCommands = 25;

// What came of the commands, over all sequences of a test: an executive that refuses everything has
// nothing to end.
struct Tally {
  std::size_t submitted = 0, accepted = 0, succeeded = 0, cancels = 0, faults = 0, changes = 0;
};

// The two arms and how they stand to each other.
struct World {
  std::array<std::string, 2> arms;
  CellDescription description;
  int pause_ms;   // between two commands, at most
  int bothering;  // of ten commands other than new jobs so many are given
  double (*apart_m)(const Configuration& q);  // how far the two balls are; null: not watched
};

class RandomCommands {
 public:
  explicit RandomCommands(std::uint64_t seed, const std::string& policy, World world)
      : random_(seed),
        arms_(world.arms),
        cell_(hurried(std::move(world.description)), policy),
        pause_ms_(world.pause_ms),
        bothering_(world.bothering),
        apart_m_(world.apart_m) {}

  Tally run() {
    for (int i = 0; i < kCommands; ++i) {
      command();
      run_for(std::chrono::milliseconds(pick(0, pause_ms_)));
      compare();
    }
    end_all();
    compare();
    judge_the_log();
    return tally_;
  }

 private:
  static CellDescription hurried(CellDescription cell) {
    cell.scheduling.backlog_timeout = 3s;
    cell.checking.time_step = 50ms;
    return cell;
  }

  int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  Executive& executive() { return cell_.simulation->executive(); }

  // A move of one or both arms from where they will stand, sometimes from somewhere else.
  JobRequest random_job() {
    const Snapshot now = executive().snapshot();
    JobRequest request;
    std::vector<double> from, to;
    const int which = pick(0, 8);  // 0..3 the first, 4..7 the second, 8 both
    for (const std::size_t arm : {0u, 1u}) {
      if (which < 8 && (which < 4) != (arm == 0)) continue;
      request.trajectory.joint_names.push_back(arms_[arm] + "_slide");
      from.push_back(predicted(now, arm) + (pick(0, 19) == 0 ? 0.2 : 0.0));
      to.push_back(0.1 * pick(-12, 12));
    }
    const std::vector<double> zero(from.size(), 0.0);
    request.trajectory.points = {{from, zero, zero, 0.0}, {to, zero, zero, 0.5 * pick(2, 8)}};
    request.terms.priority = pick(-1, 1);
    if (!now.jobs.empty() && pick(0, 4) == 0) {
      request.after = {
          now.jobs[static_cast<std::size_t>(pick(0, static_cast<int>(now.jobs.size()) - 1))].key};
    }
    return request;
  }

  // Where the arm stands when the jobs accepted for it have run; while the server sends it aside,
  // where clients left it.
  double predicted(const Snapshot& now, std::size_t arm) {
    double q = now.arms[arm].q.front();
    for (const JobView& job : now.jobs) {
      const bool of_this = std::ranges::find(job.arms, arms_[arm]) != job.arms.end();
      if (!of_this || is_terminal(job.state)) continue;
      q = job.system_job ? left_[arm] : goals_.at({job.key, arms_[arm]});
    }
    for (const JobView& job : now.jobs) {
      const auto goal = goals_.find({job.key, arms_[arm]});
      if (!is_terminal(job.state) && goal != goals_.end()) q = goal->second;
    }
    return left_[arm] = q;
  }

  void submit(JobRequest request) {
    const auto joints = request.trajectory.joint_names;
    const auto goal = request.trajectory.points.back().positions;
    remember(executive().submit(std::move(request)), joints, goal);
  }
  void remember(const Result<JobView>& accepted, const std::vector<std::string>& joints,
                const std::vector<double>& goal) {
    ++tally_.submitted;
    if (!accepted) return;
    ++tally_.accepted;
    submitted_.push_back(accepted->key);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      goals_[{accepted->key, joints[j].substr(0, 1)}] = goal[j];
    }
  }

  void command() {
    const auto arm = ArmId{static_cast<std::uint32_t>(pick(0, 1))};
    const int which = pick(0, 13);
    const bool given = bothering_ == 10 || which < 5 || pick(1, 10) <= bothering_;
    switch (given ? which : 0) {
      case 0:
      case 1:
      case 2:
      case 3:
        return submit(random_job());
      case 4:
        return batch();
      case 5:
      case 6:
        return cancel();
      case 7:
        return executive().stop({arm}, "random");
      case 8:
        return executive().resume({arm});
      case 9:
        return resume_all(executive());
      case 10:
        return change_scene();
      case 11:
        return inject(ArmFault::Kind::stall, 0.0);
      case 12:
        return inject(ArmFault::Kind::slow, 0.5);
      default:
        return inject(ArmFault::Kind::fault, 0.0);
    }
  }

  void batch() {
    std::vector<JobRequest> jobs = {random_job(), random_job()};
    std::vector<JobRequest> copy = jobs;
    const auto answers = submit_batch(executive(), std::move(jobs), pick(0, 1) == 0);
    if (!answers) return;
    for (std::size_t i = 0; i < copy.size(); ++i) {
      remember((*answers)[i], copy[i].trajectory.joint_names,
               copy[i].trajectory.points.back().positions);
    }
  }

  void cancel() {
    if (submitted_.empty()) return;
    const auto i = static_cast<std::size_t>(pick(0, static_cast<int>(submitted_.size()) - 1));
    tally_.cancels += executive().cancel(submitted_[i]) ? 1 : 0;
  }

  void change_scene() {
    CollisionObject ball{.name = "ball", .shape = Sphere{0.05}};
    ball.X_WO.translation().x() = 0.1 * pick(-10, 10);
    if (bothering_ < 10) ball.X_WO.translation().y() = 0.1 * pick(0, 5);
    if (executive().scene().objects().empty()) {
      tally_.changes += executive().scene().add(ball) ? 1 : 0;
    } else if (pick(0, 1) == 0) {
      tally_.changes += executive().scene().replace(ball) ? 1 : 0;
    } else {
      tally_.changes += executive().scene().remove("ball") ? 1 : 0;
    }
  }

  void inject(ArmFault::Kind kind, double value) {
    const auto injected =
        executive().faults().inject({.arm = arms_[static_cast<std::size_t>(pick(0, 1))],
                                     .kind = kind,
                                     .lasting = std::chrono::milliseconds(pick(100, 1500)),
                                     .value = value});
    tally_.faults += injected ? 1 : 0;
  }

  void run_for(Duration duration) {
    const TimePoint until = cell_.simulation->now() + duration;
    while (cell_.simulation->now() < until) {
      cell_.simulation->tick();
      if (apart_m_ != nullptr) closest_m_ = std::min(closest_m_, apart_m_(cell_.log.last));
    }
  }

  // What is left is canceled: it must end, whatever state it was in. An arm may be sent aside or
  // back even then, once.
  void end_all() {
    for (int turn = 0; turn < 3; ++turn) {
      for (const std::string& key : submitted_) static_cast<void>(executive().cancel(key));
      run_for(1s);
      compare();
    }
    cell_.run_to_the_end(cell_.simulation->now() + 30s);
  }

  // Jobs, queue and the last event of each job say the same.
  void compare() {
    const Snapshot now = executive().snapshot();
    std::map<std::string, std::string> place;
    for (const auto& [list, keys] :
         {std::pair{"queued", now.queue.queued}, std::pair{"backlog", now.queue.backlog},
          std::pair{"scheduled", now.queue.scheduled}, std::pair{"running", now.queue.running}}) {
      for (const std::string& key : keys) {
        EXPECT_TRUE(place.emplace(key, list).second) << key << " stands twice in the queue";
      }
    }
    for (; read_ < cell_.log.events.size(); ++read_) {
      const auto* job = std::get_if<JobView>(&cell_.log.events[read_].body);
      if (job == nullptr) continue;
      told_[job->key] = *job;
      const bool own = job->key.starts_with("aside-");
      if (own && own_.insert(job->key).second) submitted_.push_back(job->key);
    }
    for (const JobView& job : now.jobs) {
      ASSERT_TRUE(told_.contains(job.key)) << "no event tells of " << job.key;
      EXPECT_EQ(told_[job.key].state, job.state) << job.key;
      EXPECT_EQ(told_[job.key].motion.stopping, job.motion.stopping) << job.key;
      EXPECT_EQ(place.contains(job.key), !is_terminal(job.state)) << job.key;
    }
    for (const ArmView& arm : now.arms) {
      if (arm.job.empty()) continue;
      const JobView job = cell_.job(arm.job);
      EXPECT_FALSE(is_terminal(job.state)) << "a reservation outlives " << arm.job;
    }
  }

  void judge_the_log() {
    std::map<std::string, int> endings;
    std::uint64_t seq = 0;
    for (const Event& event : cell_.log.events) {
      EXPECT_EQ(event.seq, ++seq) << "the log has a hole";
      if (const auto* job = std::get_if<JobView>(&event.body)) {
        endings[job->key] += is_terminal(job->state) ? 1 : 0;
        tally_.succeeded += job->state == JobState::succeeded ? 1 : 0;
      }
    }
    for (const std::string& key : submitted_) EXPECT_EQ(endings[key], 1) << key;
    EXPECT_TRUE(executive().all_ended());
    EXPECT_LE(own_.size(), 4 * (submitted_.size() - own_.size())) << "arms go to and fro";
    EXPECT_GT(closest_m_, 0.0) << "contact";  // where that is measured
    for (const ArmView& arm : executive().snapshot().arms) EXPECT_EQ(arm.job, "");
  }

  std::mt19937_64 random_;
  std::array<std::string, 2> arms_;
  Crossing cell_;
  std::vector<std::string> submitted_;  // the server's own included
  std::set<std::string> own_;
  std::array<double, 2> left_{};  // where clients left the arms
  std::map<std::pair<std::string, std::string>, double> goals_;
  std::map<std::string, JobView> told_;
  std::size_t read_ = 0;
  int pause_ms_, bothering_;
  double (*apart_m_)(const Configuration& q);
  double closest_m_ = 1e9;
  Tally tally_;
};

}  // namespace armloom::random_commands
