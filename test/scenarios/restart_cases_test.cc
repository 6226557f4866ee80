#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

// Acknowledges writes when the test calls write_all().
struct SlowLog final : StartLog {
  void about_to_move(JobId job, std::function<void()> written) override {
    EXPECT_TRUE(asked.emplace(job, true).second) << "asked twice for one job";
    open.emplace_back(job, std::move(written));
  }
  void has_moved(JobId, const HeldView&, std::function<void()> written) override { written(); }
  void write_all() {
    for (auto& [job, written] : std::exchange(open, {})) written();
  }
  std::map<JobId, bool> asked;
  std::vector<std::pair<JobId, std::function<void()>>> open;
};

struct Restarted : Crossing {
  explicit Restarted(StartLog* starts, const std::string& policy = "coordinated",
                     JobId first_job = JobId{1})
      : Crossing() {
    auto created = Simulation::create(
        *build_cell(crossing_description()),
        ExecutiveOptions{.policy = policy, .first_job = first_job, .starts = starts}, log);
    if (!created) throw std::runtime_error(created.error().front().detail);
    simulation = std::move(*created);
    simulation->tick();
  }
  Executive& executive() { return simulation->executive(); }
  double x() const { return log.last[0]; }
};

TEST(StartLog, NoArmMovesBeforeItsStartIsStored) {
  for (const std::string& policy : known_policies()) {
    SlowLog starts;
    Restarted cell(&starts, policy);
    cell.submit(slide("x", -1, 1, 4, "go"));
    cell.run_until(at(1s));
    ASSERT_EQ(starts.open.size(), 1U) << policy;
    EXPECT_EQ(cell.x(), -1.0) << policy;
    EXPECT_EQ(cell.job("go").state, JobState::scheduled) << policy;
    EXPECT_FALSE(cell.job("go").times.started_at) << policy;
    starts.write_all();
    cell.run_to_the_end();
    EXPECT_EQ(cell.job("go").state, JobState::succeeded) << policy;
    EXPECT_EQ(starts.asked.size(), 1U) << policy << ": once is enough";
  }
}

// The disk hangs for longer than the job may take.
TEST(StartLog, AStartThatIsStoredLateIsNoOverrun) {
  SlowLog starts;
  Restarted cell(&starts);
  cell.submit(slide("x", -1, 1, 4, "go"));
  cell.run_until(at(40s));
  EXPECT_EQ(cell.job("go").state, JobState::scheduled);
  starts.write_all();
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("go").state, JobState::succeeded);
  EXPECT_EQ(cell.x(), 1.0);
}

TEST(StartLog, JobStoppedMeanwhileContinuesWhenResumed) {
  SlowLog starts;
  Restarted cell(&starts);
  cell.submit(slide("x", -1, 1, 4, "go"));
  cell.run_until(at(500ms));
  stop_all(cell.executive(), "test");
  cell.run_until(at(1s));
  starts.write_all();
  cell.run_until(at(2s));
  EXPECT_EQ(cell.x(), -1.0) << "it was written, but all is stopped";
  resume_all(cell.executive());
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("go").state, JobState::succeeded);
}

TEST(StartLog, JobStoppedAndResumedMeanwhileStillWaits) {
  SlowLog starts;
  Restarted cell(&starts);
  cell.submit(slide("x", -1, 1, 4, "go"));
  cell.run_until(at(500ms));
  stop_all(cell.executive(), "test");
  cell.run_until(at(1s));
  resume_all(cell.executive());
  cell.run_until(at(2s));
  EXPECT_EQ(cell.x(), -1.0);
  starts.write_all();
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("go").state, JobState::succeeded);
}

TEST(StartLog, JobCanceledMeanwhileNeverMoves) {
  SlowLog starts;
  Restarted cell(&starts);
  cell.submit(slide("x", -1, 1, 4, "go"));
  cell.run_until(at(500ms));
  ASSERT_TRUE(cell.executive().cancel("go"));
  cell.run_until(at(1s));
  EXPECT_EQ(cell.job("go").state, JobState::canceled);
  starts.write_all();
  cell.run_until(at(2s));
  EXPECT_EQ(cell.x(), -1.0);
}

TEST(StartLog, LateAnswersCauseNoContact) {
  int jobs = 0;
  for (const std::string& policy : known_policies()) {
    if (policy == "timed_discrete") continue;  // promises nothing
    for (unsigned seed = 1; seed <= 12; ++seed) {
      std::mt19937 random(seed);
      const auto below = [&](int n) {
        return static_cast<int>(random() % static_cast<unsigned>(n));
      };
      SlowLog starts;
      Restarted cell(&starts, policy);
      double x = -1, y = -1;
      for (int step = 1; step <= 400; ++step) {
        cell.run_until(at(step * 50ms));
        if (step < 200 && below(20) == 0) {
          double& from = below(2) == 0 ? x : y;
          const double to = from < 0 ? 1 : -1;
          cell.submit(slide(&from == &x ? "x" : "y", from, to, 2 + below(3)));
          from = to;
          ++jobs;
        }
        if (below(6) == 0) {
          std::ranges::shuffle(starts.open, random);
          starts.write_all();
        }
      }
      for (int i = 0; i < 2000 && !cell.executive().all_ended(); ++i) {
        starts.write_all();
        cell.run_until(cell.simulation->now() + 50ms);
      }
      EXPECT_TRUE(cell.executive().all_ended()) << policy << ", seed " << seed;
      EXPECT_GT(cell.log.closest_m, 0.0) << policy << ", seed " << seed;
    }
  }
  EXPECT_GT(jobs, 300);
}

std::vector<RestoredJob> two_of_x() {
  std::vector<RestoredJob> jobs;
  jobs.push_back({JobId{7}, slide("x", -1, 0.5, 2, "first"), at(-10s)});
  jobs.push_back({JobId{12}, slide("x", 0.5, -1, 2, "second"), at(-5s)});
  jobs.back().request.after = {"first", "long-ago"};
  jobs.back().request.known.succeeded = {"long-ago"};
  return jobs;
}

TEST(Restore, KeepsIdsOrderAndPredecessors) {
  Restarted cell(nullptr, "coordinated", JobId{20});
  stop_all(cell.executive(), "restart");
  const auto answers = cell.executive().restore(two_of_x());
  ASSERT_TRUE(answers[0] && answers[1]);
  cell.run_until(at(3s));
  EXPECT_EQ(cell.job("first").id, JobId{7});
  EXPECT_EQ(cell.job("second").id, JobId{12});
  EXPECT_EQ(cell.job("second").times.submitted_at, at(-5s));
  EXPECT_EQ(cell.job("first").state, JobState::queued);
  EXPECT_EQ(cell.submit(slide("y", -1, 0, 2)).key, "job-20") << "numbers are never given again";
  resume_all(cell.executive());
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("second").state, JobState::succeeded);
  EXPECT_LE(*cell.job("first").times.ended_at, *cell.job("second").times.started_at);
}

TEST(Restore, FailsAJobThatStartsElsewhereOnlyAfterResume) {
  Restarted cell(nullptr);
  stop_all(cell.executive(), "restart");
  std::vector<RestoredJob> jobs;
  jobs.push_back({JobId{3}, slide("x", 0.2, -1, 2, "elsewhere"), at(-1s)});
  ASSERT_TRUE(cell.executive().restore(std::move(jobs)).front());
  cell.submit(slide("x", -1, 0, 2, "next"));
  cell.run_until(at(5s));
  EXPECT_EQ(cell.job("elsewhere").state, JobState::queued);
  resume_all(cell.executive());
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("elsewhere").reason(), Reason::start_mismatch);
  EXPECT_EQ(cell.job("next").state, JobState::succeeded);
}

// The arms are not stopped, so the server adds a move-to-start at once.
TEST(Restore, KeepsServerInitiatedJobsFromReusingIds) {
  Restarted cell(nullptr, "earliest_start", JobId{20});
  std::vector<RestoredJob> jobs;
  jobs.push_back({JobId{7}, slide("x", 0.2, -1, 2, "elsewhere"), at(-2s)});
  jobs.back().request.terms.move_to_start = MoveToStart::plan;
  jobs.push_back({JobId{8}, slide("y", -1, 0, 2, "next"), at(-1s)});
  jobs.back().request.after = {"elsewhere"};
  for (const auto& answer : cell.executive().restore(std::move(jobs))) ASSERT_TRUE(answer);
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("move-to-start-20").id, JobId{20});
  EXPECT_EQ(cell.job("elsewhere").id, JobId{7});
  EXPECT_EQ(cell.job("elsewhere").state, JobState::succeeded);
  EXPECT_EQ(cell.job("next").id, JobId{8});
  EXPECT_EQ(cell.job("next").state, JobState::succeeded);
}

TEST(Restore, RefusesJobsThatNoLongerFitTheCell) {
  Restarted cell(nullptr);
  auto jobs = two_of_x();
  jobs[0].request.trajectory.points[1].positions = {100.0};
  const auto answers = cell.executive().restore(std::move(jobs));
  EXPECT_FALSE(answers[0]);
  EXPECT_FALSE(answers[1]) << "it comes after the first";
}

TEST(WindDown, KeepsUnstartedJobsForTheNextSession) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "moves"));
  cell.submit(slide("y", -1, 1, 4, "waits"));
  cell.submit(slide("x", 1, -1, 4, "next"));
  cell.run_until(at(1500ms));
  bool done = false;
  cell.simulation->executive().wind_down("the server ends", Executive::Waiting::is_kept,
                                         [&] { done = true; });
  cell.run_until(at(3s));
  EXPECT_TRUE(done);
  EXPECT_EQ(cell.job("moves").state, JobState::interrupted);
  EXPECT_FALSE(is_terminal(cell.job("waits").state));
  EXPECT_EQ(cell.job("next").state, JobState::queued) << "though its arm stands elsewhere";
}

}  // namespace
}  // namespace armloom
