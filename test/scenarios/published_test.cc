// The values that clients read must agree with the published events, at every event. No read needs
// the strand.
#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <map>
#include <random>

#include "core/executive/job_sheet.h"
#include "core/executive/queue_lists.h"
#include "core/executive/real_time_loop.h"
#include "core/executive/status_board.h"
#include "core/executive/timeline.h"
#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

using Lists = std::vector<std::vector<std::string>>;

Lists lists_of(const QueueView& queue) {
  return {queue.queued, queue.backlog, queue.scheduled, queue.running};
}

// Follows the job events and compares them with each published queue and with the board.
class Follower final : public Observer {
 public:
  void on_event(const Event& event) override {
    if (!board) return;
    if (const auto* job = std::get_if<JobView>(&event.body)) follow(*job);
    if (const auto* queue = std::get_if<QueueView>(&event.body)) {
      EXPECT_EQ(lists_of(*queue), lists()) << "event " << event.seq;
      EXPECT_EQ(lists_of(*queue), lists_of(queue_of(board->read())));
    }
    EXPECT_LT(board->read().seq, event.seq) << "a reader would miss this event";
  }
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}

  Lists lists() const {
    Lists lists(4);
    for (const auto& [id, job] : told_) {
      if (job.state == JobState::queued) lists[0].push_back(job.key);
      if (job.state == JobState::backlogged) lists[1].push_back(job.key);
      if (job.state == JobState::scheduled) lists[2].push_back(job.key);
      if (job.state == JobState::running || job.state == JobState::paused) {
        lists[3].push_back(job.key);
      }
    }
    return lists;
  }

  std::shared_ptr<const StatusBoard> board;
  int held = 0;  // events that report a paused job

 private:
  void follow(const JobView& job) {
    told_.insert_or_assign(job.id, job);
    if (job.times.scheduled_at && job.times.started_at) {
      EXPECT_LE(*job.times.scheduled_at, *job.times.started_at) << job.key;
    }
    held += job.state == JobState::paused ? 1 : 0;
    const auto read = board->job(job.key);
    ASSERT_TRUE(read) << job.key;
    EXPECT_EQ(read->state, job.state) << job.key;
  }
  std::map<JobId, JobView> told_;
};

TrajectoryRequest there_and_back(const std::string& arm, double seconds) {
  TrajectoryRequest motion = slide(arm, -1, 1, seconds / 2, "").trajectory;
  motion.points.push_back(motion.points.front());
  motion.points.back().time_from_start_s = seconds;
  return motion;
}

JobRequest of_x_or_y(std::mt19937& random) {
  JobRequest request = slide("x", -1, 1, 1, "");
  const double seconds = 4.0 + static_cast<double>(random() % 4);
  const auto x = there_and_back("x", seconds), y = there_and_back("y", seconds);
  const auto which = random() % 3;
  request.trajectory = which == 0 ? x : y;
  if (which == 2) request.alternatives = {x, y}, request.trajectory = {};
  return request;
}

// Runs two arms that meet, with random jobs, stops and resumes; calls look() around each command.
template <class Look>
int run_at_random(unsigned seed, const std::string& policy, Look look) {
  std::mt19937 random(seed);
  Follower follower;
  const auto cell = build_cell(crossing_description());
  const auto simulation = Simulation::create(*cell, {.policy = policy}, follower);
  EXPECT_TRUE(simulation);
  Executive& executive = (*simulation)->executive();
  follower.board = executive.board();
  for (int command = 0; command < 60; ++command) {
    const std::vector<ArmId> arms{ArmId{static_cast<std::uint32_t>(random() % 2)}};
    const auto what = random() % 5;
    if (what < 2) (void)executive.submit(of_x_or_y(random)).value();
    if (what == 2) executive.stop(arms, "operator");
    if (what > 2) resume_all(executive);
    look(executive);
    const auto until = executive.now() + std::chrono::milliseconds(50 + random() % 900);
    (*simulation)->run_until(until);
    look(executive);
    EXPECT_EQ(lists_of(executive.snapshot().queue), follower.lists());
  }
  return follower.held;
}

TEST(Published, QueueAndEventsAgreeThroughStopsAndPauses) {
  int held = 0;
  for (const char* policy : {"coordinated", "earliest_start"}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE(policy + (" " + std::to_string(seed)));
      held += run_at_random(seed, policy, [](Executive&) {});
    }
  }
  EXPECT_GT(held, 10) << "hardly any job was at rest on its path";
}

TEST(Published, EveryJobIsAStepOrWaitsInItsArmQueues) {
  std::size_t waited = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    run_at_random(seed, "coordinated", [&](Executive& executive) {
      const Cell& cell = executive.scene().scene()->cell();
      const TimelineLanes lanes = lanes_of(executive.inquiries().timeline(), cell);
      for (const auto& lane : lanes.lanes) {
        std::size_t jobs = 0;
        for (const JobView& job : executive.snapshot(0).jobs) {
          jobs += static_cast<std::size_t>(std::ranges::count(job.arms, lane.arm));
        }
        EXPECT_EQ(lane.steps.size() + lane.waiting, jobs) << lane.arm << ", seed " << seed;
        waited += lane.waiting;
      }
    });
  }
  EXPECT_GT(waited, 20U);
}

TEST(Published, CanBeReadWhileTheStrandIsBusy) {
  Follower follower;
  const auto loop = RealTimeLoop::start(*build_cell(crossing_description()), {}, 1.0, follower);
  ASSERT_TRUE(loop);
  std::promise<void> is_busy, may_go_on;
  (*loop)->post([&](Executive& executive) {
    EXPECT_TRUE(executive.submit(slide("x", -1, 1, 4, "one")));
    is_busy.set_value();
    may_go_on.get_future().wait();
  });
  is_busy.get_future().wait();
  const Status status = (*loop)->board().read();
  EXPECT_EQ(queue_of(status).queued, std::vector<std::string>{"one"});
  EXPECT_EQ(status.jobs_with_ended(0).size(), 1U);
  EXPECT_NE((*loop)->board().job("one"), nullptr);
  EXPECT_EQ((*loop)->board().job("other"), nullptr);
  may_go_on.set_value();
}

TEST(Published, RolledBackJobLeavesListAndLookupTogether) {
  Follower follower;
  const auto cell = build_cell(crossing_description());
  const auto simulation = Simulation::create(*cell, {}, follower);
  ASSERT_TRUE(simulation);
  Executive& executive = (*simulation)->executive();
  const auto board = executive.board();
  const auto agree = [&] {
    const bool is_listed = board->read().jobs_with_ended(1).size() == 1;
    EXPECT_EQ(board->job("one") != nullptr, is_listed);
    return is_listed;
  };
  EXPECT_TRUE(executive.submit(slide("x", -1, 1, 4, "one")));
  EXPECT_TRUE(agree());
  executive.roll_back("one");
  agree();
  (*simulation)->run_until(executive.now() + std::chrono::seconds(1));
  EXPECT_FALSE(agree());
}

JobSheet::JobPtr job_of(std::uint64_t id, const std::string& key) {
  return std::make_shared<const JobView>(JobView{.id = JobId{id}, .key = key});
}

TEST(JobSheet, IsImmutableWhenTheLedgerChanges) {
  JobLedger ledger;
  for (std::uint64_t id = 1; id <= 1000; ++id) ledger.put(job_of(id, "old"));
  const JobSheet before = ledger.share();
  ledger.put(job_of(500, "new"));
  ledger.erase(JobId{501});
  for (std::uint64_t id = 600; id < 900; ++id) ledger.erase(JobId{id});
  const JobSheet after = ledger.share();
  EXPECT_EQ(before.find(JobId{500})->key, "old");
  EXPECT_NE(before.find(JobId{501}), nullptr);
  EXPECT_EQ(after.find(JobId{500})->key, "new");
  EXPECT_EQ(after.find(JobId{501}), nullptr);
  EXPECT_EQ(after.find(JobId{2000}), nullptr);
  EXPECT_EQ(before.find(JobId{1}), after.find(JobId{1})) << "what did not change is shared";
  std::vector<std::uint64_t> ids, newest;
  after.each([&](const auto& job) { ids.push_back(job->id.value()); });
  after.newest_first([&](const auto& job) {
    newest.push_back(job->id.value());
    return newest.size() < 200;
  });
  EXPECT_EQ(ids.size(), 699U);
  EXPECT_TRUE(std::ranges::is_sorted(ids));
  EXPECT_TRUE(std::equal(newest.begin(), newest.end(), ids.rbegin()));
}

}  // namespace
}  // namespace armloom
