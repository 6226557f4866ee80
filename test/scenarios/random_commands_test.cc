// 2,000 random command sequences through the whole executive: whatever is asked in whatever order,
// every submitted job reaches exactly one terminal state, events, jobs and queue tell the same
// story, no reservation outlives its job, and nothing touches but for what a fault or the coarse
// step lets through (the monitor's business).
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

constexpr std::uint64_t kSequences = 2000;  // of each policy its share
constexpr int kCommands = 25;

class RandomCommands {
 public:
  explicit RandomCommands(std::uint64_t seed, const std::string& policy)
      : random_(seed), cell_(description(), policy) {}

  void run() {
    for (int i = 0; i < kCommands; ++i) {
      command();
      cell_.run_until(cell_.simulation->now() + std::chrono::milliseconds(pick(0, 400)));
      compare();
    }
    end_all();
    compare();
    judge_the_log();
  }

 private:
  static CellDescription description() {
    CellDescription cell = crossing_description();
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
    const int which = pick(0, 8);  // 0..3 x, 4..7 y, 8 both
    for (const std::size_t arm : {0u, 1u}) {
      if (which < 8 && (which < 4) != (arm == 0)) continue;
      request.trajectory.joint_names.push_back(arm == 0 ? "x_slide" : "y_slide");
      from.push_back(predicted(now, arm) + (pick(0, 19) == 0 ? 0.2 : 0.0));
      to.push_back(0.1 * pick(-12, 12));
    }
    const std::vector<double> zero(from.size(), 0.0);
    request.trajectory.points = {{from, zero, zero, 0.0}, {to, zero, zero, 0.5 * pick(2, 8)}};
    request.priority = pick(-1, 1);
    if (!now.jobs.empty() && pick(0, 4) == 0) {
      request.after = {
          now.jobs[static_cast<std::size_t>(pick(0, static_cast<int>(now.jobs.size()) - 1))].key};
    }
    return request;
  }

  // Where the arm stands when the jobs accepted for it have run.
  double predicted(const Snapshot& now, std::size_t arm) {
    const std::string name = arm == 0 ? "x" : "y";
    double q = now.arms[arm].q.front();
    for (const JobView& job : now.jobs) {
      const auto goal = goals_.find({job.key, name});
      if (!is_terminal(job.state) && goal != goals_.end()) q = goal->second;
    }
    return q;
  }

  void submit(JobRequest request) {
    const auto joints = request.trajectory.joint_names;
    const auto goal = request.trajectory.points.back().positions;
    remember(executive().submit(std::move(request)), joints, goal);
  }
  void remember(const Result<JobView>& accepted, const std::vector<std::string>& joints,
                const std::vector<double>& goal) {
    if (!accepted) return;
    submitted_.push_back(accepted->key);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      goals_[{accepted->key, joints[j].substr(0, 1)}] = goal[j];
    }
  }

  void command() {
    const auto arm = ArmId{static_cast<std::uint32_t>(pick(0, 1))};
    switch (pick(0, 13)) {
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
        return executive().resume_all();
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
    const auto answers = executive().submit_batch(std::move(jobs), pick(0, 1) == 0);
    if (!answers) return;
    for (std::size_t i = 0; i < copy.size(); ++i) {
      remember((*answers)[i], copy[i].trajectory.joint_names,
               copy[i].trajectory.points.back().positions);
    }
  }

  void cancel() {
    if (submitted_.empty()) return;
    const auto i = static_cast<std::size_t>(pick(0, static_cast<int>(submitted_.size()) - 1));
    static_cast<void>(executive().cancel(submitted_[i]));
  }

  void change_scene() {
    CollisionObject ball{.name = "ball", .shape = Sphere{0.05}};
    ball.X_WO.translation().x() = 0.1 * pick(-10, 10);
    if (executive().objects().empty()) {
      static_cast<void>(executive().add_object(ball));
    } else if (pick(0, 1) == 0) {
      static_cast<void>(executive().replace_object(ball));
    } else {
      static_cast<void>(executive().remove_object("ball"));
    }
  }

  void inject(ArmFault::Kind kind, double value) {
    static_cast<void>(executive().inject({.arm = pick(0, 1) == 0 ? "x" : "y",
                                          .kind = kind,
                                          .lasting = std::chrono::milliseconds(pick(100, 1500)),
                                          .value = value}));
  }

  // What is left is canceled: it must end, whatever state it was in.
  void end_all() {
    for (const std::string& key : submitted_) static_cast<void>(executive().cancel(key));
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
      if (const auto* job = std::get_if<JobView>(&cell_.log.events[read_].body)) {
        told_[job->key] = *job;
      }
    }
    for (const JobView& job : now.jobs) {
      ASSERT_TRUE(told_.contains(job.key)) << "no event tells of " << job.key;
      EXPECT_EQ(told_[job.key].state, job.state) << job.key;
      EXPECT_EQ(told_[job.key].stopping, job.stopping) << job.key;
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
      }
    }
    for (const std::string& key : submitted_) EXPECT_EQ(endings[key], 1) << key;
    EXPECT_TRUE(executive().all_ended());
    for (const ArmView& arm : executive().snapshot().arms) EXPECT_EQ(arm.job, "");
  }

  std::mt19937_64 random_;
  Crossing cell_;
  std::vector<std::string> submitted_;
  std::map<std::pair<std::string, std::string>, double> goals_;
  std::map<std::string, JobView> told_;
  std::size_t read_ = 0;
};

void run_sequences(std::uint64_t first, std::uint64_t last, const std::string& policy) {
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    SCOPED_TRACE(policy + ", seed " + std::to_string(seed));
    RandomCommands(seed, policy).run();
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(RandomCommands, EveryJobReachesExactlyOneEnd) {
  run_sequences(1, kSequences * 3 / 10, "timed_discrete");
}
TEST(RandomCommands, EveryJobReachesExactlyOneEndUnderCertified) {
  run_sequences(kSequences * 3 / 10 + 1, kSequences * 13 / 20, "certified");
}
TEST(RandomCommands, EveryJobReachesExactlyOneEndUnderEarliestStart) {
  run_sequences(kSequences * 13 / 20 + 1, kSequences, "earliest_start");
}
TEST(RandomCommands, EveryJobReachesExactlyOneEndUnderCoordinated) {
  run_sequences(kSequences + 1, kSequences * 27 / 20, "coordinated");
}

}  // namespace
}  // namespace armloom
