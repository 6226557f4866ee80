#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "test/scenarios/crossing.h"
#include "test/scenarios/team_run.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
constexpr double kHoldsUnderDelays_m = 0.015;  // the cell's clearance minus tracking errors

}  // namespace

void TeamsRun::explain_what_waits() {
  const Snapshot now = executive().snapshot();
  // The waits of jobs and of arms. The key of an arm with jobs is "arm:NAME".
  std::map<std::string, std::set<std::string>> waits;
  std::set<std::string> explained;
  for (const JobView& job : now.jobs) {
    if (is_terminal(job.state)) continue;
    for (const std::string& arm : job.arms) {
      auto& of_arm = waits["arm:" + arm];
      const bool behind = job.state == JobState::scheduled && job.waits_on.empty();
      // is not published as a wait
      if (behind) waits[job.key].insert(of_arm.begin(), of_arm.end());
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

void TeamsRun::compare() {
  const Snapshot now = executive().snapshot();
  std::map<std::string, int> places;  // number of the queue's lists that contain the job
  for (const auto& keys :
       {now.queue.queued, now.queue.backlog, now.queue.scheduled, now.queue.running}) {
    for (const std::string& key : keys) ++places[key];
  }
  for (const JobView& job : now.jobs) {
    ASSERT_TRUE(told_.contains(job.key)) << "no event tells of " << job.key;
    EXPECT_EQ(told_.at(job.key).state, job.state) << job.key;
    EXPECT_EQ(told_.at(job.key).motion.stopping, job.motion.stopping) << job.key;
    EXPECT_EQ(places[job.key], is_terminal(job.state) ? 0 : 1) << job.key;
  }
  for (const ArmView& arm : now.arms) {
    if (arm.job.empty()) continue;
    EXPECT_FALSE(is_terminal(told_.at(arm.job).state)) << "a reservation outlives " << arm.job;
  }
}

void TeamsRun::end_all() {
  for (int turn = 0; turn < 4 && !executive().all_ended(); ++turn) {
    for (const std::string& key : keys_) static_cast<void>(executive().cancel(key));
    simulation_->run_until(simulation_->now() + 8s);
    note_own_jobs();
  }
  EXPECT_TRUE(executive().all_ended()) << "jobs outlive their cancel";
}

void TeamsRun::judge(TeamTally& tally) {
  std::map<std::string, int> endings;
  std::uint64_t seq = 0;
  for (const Event& event : watched_.events) {
    EXPECT_EQ(event.seq, ++seq) << "the log has a hole";
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

void TeamsRun::tell() {
  std::cout << description_.name << " of " << arms_.size() << ", closest " << watched_.smallest_m
            << " at " << to_seconds(watched_.when) << " s\n";
  for (const Event& event : watched_.events) {
    const double time_s = to_seconds(event.time);
    if (const auto* job = std::get_if<JobView>(&event.body)) {
      std::cout << time_s << " s: " << armloom::told(*job) << " at "
                << job->motion.progress * to_seconds(job->motion.duration) << "\n";
    } else if (const auto* alert = std::get_if<Alert>(&event.body)) {
      std::cout << time_s << " s: " << alert->text << "\n";
    } else if (const auto* found = std::get_if<MonitorEvent>(&event.body)) {
      std::cout << time_s << " s: monitor, stops";
      for (const std::string& arm : found->stopped) std::cout << " " << arm;
      std::cout << "\n";
    }
  }
}

}  // namespace armloom
