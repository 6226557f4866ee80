// The same with Pandas: random poses around home, from one to the next, of which the run one by one
// succeeds (jobs for which it does not are left out). ARMLOOM_SEEDS=100 runs so many of each cell.
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <sstream>

#include "core/audit/audit.h"
#include "core/executive/known_policies.h"
#include "core/model/cell/build_cell.h"
#include "core/trajectory/joint_line.h"
#include "server/codec/cell_codec.h"
#include "test/scenarios/random_faults.h"
#include "test/scenarios/seeds.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kSeeds = 1;
constexpr std::size_t kJobs = 20;

CellPtr pandas(const std::string& name) {
  std::ifstream file(source_dir() + "/config/" + name + ".json");
  std::ostringstream text;
  text << file.rdbuf();
  CellDescription description = *read_cell_text(text.str(), source_dir() + "/config");
  description.scheduling.backlog_timeout = 100000s;
  description.scheduling.on_idle_blocker = OnIdleBlocker::report;
  return *build_cell(description);
}

struct Recorder final : Observer {
  void on_event(const Event&) override {}
  void on_state(const StateFrame&) override {}
  void on_tick(TimePoint now, const Configuration& measured) override {
    if (states.empty() || now >= states.back().time + 5ms) states.push_back({now, measured});
  }
  std::vector<RecordedState> states;
};

// A motion of this arm to somewhere around its home.
JobRequest somewhere(const Cell& cell, ArmId id, const Eigen::VectorXd& from, Random& random,
                     Eigen::VectorXd& to) {
  const Arm& arm = cell.arm(id);
  JobRequest job{.key = "", .name = "", .trajectory = {}};
  for (;;) {
    to = arm.home;
    for (double& q : to) q += random.uniform(-1.3, 1.3);
    const auto line = joint_line(cell, arm.joints, from, to);
    if (!line) continue;  // outside of a limit
    for (JointId joint : arm.joints) job.trajectory.joint_names.push_back(cell.joint(joint).name);
    const auto row = [](const Eigen::VectorXd& q) { return std::vector(q.begin(), q.end()); };
    const std::vector<double> rest(arm.joints.size(), 0.0);
    const double lasts_s = to_seconds((*line)->duration()) * random.uniform(1.2, 3.0);
    job.trajectory.points = {{row(from), rest, rest, 0.0}, {row(to), rest, rest, lasts_s}};
    return job;
  }
}

std::vector<JobRequest> chain(const CellPtr& cell, std::uint64_t seed) {
  Random random(seed);
  Recorder nobody;
  auto created = Simulation::create(cell, ExecutiveOptions{.policy = "sequential"}, nobody);
  Simulation& simulation = **created;
  Executive& executive = simulation.executive();
  simulation.tick();
  std::vector<Eigen::VectorXd> stands;
  for (const Arm& arm : cell->arms) stands.push_back(arm.home);
  std::vector<JobRequest> jobs;
  for (int tries = 0; jobs.size() < kJobs && tries < 2000; ++tries) {
    const std::size_t arm = random.index(stands.size());
    Eigen::VectorXd to;
    const JobRequest job =
        somewhere(*cell, ArmId{static_cast<std::uint32_t>(arm)}, stands[arm], random, to);
    const auto accepted = executive.submit(job);
    if (!accepted) continue;
    JobState state = JobState::queued;
    while (state != JobState::backlogged && !is_terminal(state)) {
      simulation.tick();
      state = executive.job(accepted->key)->state;
    }
    if (state == JobState::backlogged) {
      EXPECT_TRUE(executive.cancel(accepted->key));
    }
    if (state != JobState::succeeded) continue;
    stands[arm] = to;
    jobs.push_back(job);
  }
  EXPECT_EQ(jobs.size(), kJobs) << "seed " << seed;
  return jobs;
}

class PandaChains : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, PandaChains, ::testing::ValuesIn(known_policies()));

TEST_P(PandaChains, AllSucceedAndTheAuditFindsNoContact) {
  for (const char* name : {"two_pandas", "four_pandas"}) {
    const CellPtr cell = pandas(name);
    std::size_t succeeded = 0, jobs = 0;
    double makespan_s = 0.0;
    Judging judging;
    for (std::uint64_t seed = 1; seed <= seed_count(kSeeds); ++seed) {
      std::vector<TimedJob> timed;
      for (JobRequest& job : chain(cell, seed)) timed.push_back({at(0s), std::move(job)});
      Recorder recorder;
      const auto result =
          simulate(cell, ExecutiveOptions{.policy = GetParam()}, {timed, at(600s)}, recorder);
      ASSERT_TRUE(result);
      for (const JobView& job : result->jobs) {
        EXPECT_EQ(job.state, JobState::succeeded) << name << " seed " << seed << ": " << told(job);
        succeeded += job.state == JobState::succeeded ? 1 : 0;
      }
      jobs += timed.size();
      makespan_s += to_seconds(result->figures.last_end);
      judging.judgements += result->judging.judgements;
      judging.wall += result->judging.wall;
      const auto audited = *audit(*cell, recorder.states, 2ms);
      if (GetParam() == "timed_discrete") continue;  // promises nothing between its instants
      EXPECT_FALSE(audited.first_contact)
          << name << " seed " << seed << " at " << to_seconds(audited.first_contact->time) << " s";
    }
    std::cout << GetParam() << ", " << name << ": " << succeeded << " of " << jobs << " jobs, "
              << makespan_s << " s; " << judging.judgements << " judgements in "
              << to_seconds(judging.wall) << " s\n";
    EXPECT_EQ(succeeded, jobs);
  }
}

}  // namespace
}  // namespace armloom
