#include "server/replay/replay.h"

#include <gtest/gtest.h>

#include "server/codec/read_text.h"
#include "server/replay/input_format.h"
#include "test/scenarios/seeds.h"
#include "test/server/live_run.h"

namespace armloom {
namespace {

using test::LiveRun;
using test::Told;
using test::two_pandas;

TEST(Replay, ReproducesTheSameEvents) {
  const std::vector<std::string> policies{"earliest_start", "coordinated", "certified"};
  std::size_t inputs = 0, events = 0, planned = 0, steps_checked = 0, expired = 0;
  std::map<std::string, int> ended;
  for (std::uint64_t seed = 1; seed <= seed_count(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    LiveRun run(seed, policies[seed % policies.size()]);
    run.run(6000);
    Told told;
    auto replay = Replay::begin(two_pandas(), run.log.front(), told);
    ASSERT_TRUE(replay) << replay.error().front().detail;
    for (std::size_t i = 1; i < run.log.size(); ++i) {
      const auto taken = (*replay)->take(run.log[i]);
      ASSERT_TRUE(taken) << "line " << i + 1 << ": " << taken.error().front().detail;
    }
    (*replay)->run_until(run.ended_at());
    ASSERT_EQ(told.events.size(), run.events.size());
    for (std::size_t i = 0; i < told.events.size(); ++i) {
      ASSERT_EQ(told.events[i], run.events[i]) << "event " << i;
    }
    const RunFigures& a = run.executive().figures();
    const RunFigures& b = (*replay)->executive().figures();
    EXPECT_EQ(a.busy, b.busy);
    EXPECT_EQ(a.min_clearance_m, b.min_clearance_m);
    inputs += run.log.size();
    events += run.events.size();
    expired += static_cast<std::size_t>(std::ranges::count_if(run.log, [](const std::string& line) {
      return line.find("\"expire_objects\"") != line.npos;
    }));
    planned += run.planned;
    steps_checked += run.further_steps_checked;
    for (const auto& [state, count] : run.ended) ended[state] += count;
  }
  std::printf(
      "%zu inputs, %zu events, %d jobs succeeded, %d canceled, %d failed, %d expired; %zu ways "
      "planned and %zu jobs with steps checked beside them\n",
      inputs, events, ended["succeeded"], ended["canceled"], ended["failed"], ended["expired"],
      planned, steps_checked);
  EXPECT_GT(inputs, 50 * seed_count(100));
  EXPECT_GT(expired, 0u);
  EXPECT_GT(ended["succeeded"], 0);
  EXPECT_GT(ended["canceled"], 0);
  EXPECT_GT(planned, seed_count(100) / 10);
  EXPECT_GT(steps_checked, seed_count(100) / 10);
}

TEST(Replay, ReportsWhereItDiverges) {
  LiveRun run(3, "certified");
  run.run(3000);
  const auto judged = std::ranges::find_if(
      run.log, [](const std::string& line) { return line.find("\"judged\"") != line.npos; });
  ASSERT_NE(judged, run.log.end());
  const std::string logged = *judged;
  judged->insert(judged->size() - 1, "1");  // changes the number of evaluations
  Told told;
  auto replay = Replay::begin(two_pandas(), run.log.front(), told);
  for (std::size_t i = 1; i < run.log.size(); ++i) {
    const auto taken = (*replay)->take(run.log[i]);
    if (taken) continue;
    EXPECT_EQ(taken.error().front().slug, "diverged");
    EXPECT_NE(taken.error().front().detail.find(logged), std::string::npos);
    return;
  }
  FAIL() << "it was not seen";
}

TEST(InputFormat, WritesTheIndexOfAStepUnlessItIsTheFirst) {
  using Written = ExecutiveInput::StartWritten;
  const auto compare = [](StepId step, const std::string& text) {
    EXPECT_EQ(text_of(*logged_input_format(), {5, {Written{step}}}), text);
    const auto read = read_text(*logged_input_format(), text);
    ASSERT_TRUE(read) << read.error().front().detail;
    EXPECT_EQ(std::get<Written>(read->input.what).step, step);
  };
  compare(StepId{JobId{7}}, R"({"ticks":5,"input":"start_written","job":7})");
  compare(StepId{JobId{7}, 2}, R"({"ticks":5,"input":"start_written","job":7,"step":2})");
}

TEST(Replay, RefusesInvalidLogs) {
  Told told;
  for (const char* head :
       {"", "{}", "[1]", R"({"armloom_inputs": 2})", R"({"armloom_inputs": 1})"}) {
    EXPECT_FALSE(Replay::begin(two_pandas(), head, told)) << head;
  }
  auto replay =
      Replay::begin(two_pandas(), text_of(*input_log_head_format(), {"certified", 1, 1}), told);
  for (const char* line :
       {"", "{", "{}", R"({"ticks": 1})", R"({"ticks": 1, "input": "dance"})",
        R"({"ticks": 1, "input": "stop", "arms": ["nobody"], "cause": ""})",
        R"({"ticks": 1, "input": "submit", "jobs": [{"body": null}]})",
        R"({"ticks": 1, "input": "went_on"})", R"({"ticks": 1, "input": "judged"})"}) {
    EXPECT_FALSE((*replay)->take(line)) << line;
  }
}

}  // namespace
}  // namespace armloom
