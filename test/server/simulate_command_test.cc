#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "server/recording/recording.h"
#include "test/server/command_fixture.h"
#include "test/server/panda_jobs.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::kCell;
using test::Outcome;

class Simulate : public test::CommandFixture {};

TEST_F(Simulate, PrintsASummaryAndRepeatsByteForByte) {
  const std::string jobs = conflicting_jobs().string();
  const std::string simulate = "simulate --cell " + kCell + " --jobs " + jobs + " --seed 7 --out ";
  const Outcome outcome = run(simulate + (folder_ / "a").string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json figures = outcome.last_line();
  EXPECT_EQ(figures["policy"], "earliest_start");
  EXPECT_EQ(figures["jobs"]["succeeded"], 4);
  EXPECT_GE(figures["backlogged"], 1);
  EXPECT_GT(figures["makespan_s"], 6.5);   // some job has to wait ...
  EXPECT_LT(figures["makespan_s"], 11.0);  // ... but not for all others
  EXPECT_EQ(figures["monitor_stops"], 0);
  EXPECT_EQ(figures["arm_busy_ratio"].size(), 2U);
  EXPECT_EQ(figures["wait_s"]["max"].is_number(), true);

  ASSERT_EQ(run(simulate + (folder_ / "b").string()).exit_code, 0);
  for (const char* name : {"events.jsonl", "states.csv", "jobs.json"}) {
    EXPECT_EQ(read_text_file(folder_ / "a" / name).value(),
              read_text_file(folder_ / "b" / name).value())
        << name;
  }
  EXPECT_FALSE(fs::exists(folder_ / "a/true_states.csv")) << "feedback is true";
  const Outcome audit = run("audit --cell " + (folder_ / "a/cell.json").string() + " --recording " +
                            (folder_ / "a").string());
  EXPECT_EQ(audit.exit_code, 0) << audit.err;
  EXPECT_TRUE(audit.last_line()["contact"].is_null());
  EXPECT_GT(audit.last_line()["smallest_clearance_m"], 0.0);
}

TEST_F(Simulate, FaultsOnlyCostTime) {
  const std::string simulate = "simulate --cell " +
                               changed_cell("/execution/duration_margin_s", 60).string() +
                               " --jobs " + conflicting_jobs().string();
  const Outcome without = run(simulate);
  ASSERT_EQ(without.exit_code, 0) << without.err;
  const std::string faults =
      file("faults.json", R"([{"at_s": 1, "arm": "left", "kind": "stall", "for_s": 5},
                              {"at_s": 0, "arm": "right", "kind": "late_start", "value": 0.5}])")
          .string();
  const Outcome with = run(simulate + " --faults " + faults);
  ASSERT_EQ(with.exit_code, 0) << with.err;
  EXPECT_EQ(with.last_line()["jobs"]["succeeded"], 4);
  EXPECT_EQ(with.last_line()["monitor_stops"], 0);
  EXPECT_GT(with.last_line()["makespan_s"], without.last_line()["makespan_s"].get<double>() + 4.0);
}

TEST_F(Simulate, RecordsTruePositionsThatFeedbackHidesAndAuditChecksThem) {
  const std::string faults =
      file("faults.json",
           R"([{"at_s": 1, "arm": "left", "kind": "noise", "value": 0.0002, "for_s": 0.5}])")
          .string();
  const fs::path recording = folder_ / "recording";
  const std::string audit = "audit --cell " + kCell + " --recording " + recording.string();
  (void)run("simulate --cell " + kCell + " --jobs " + conflicting_jobs().string() + " --faults " +
            faults + " --out " + recording.string());
  const std::string truth = read_text_file(recording / "true_states.csv").value();
  EXPECT_EQ(truth.substr(truth.find('\n') + 1, 6), "1.000,");
  const Outcome whole = run(audit);
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_NE(whole.out.find("true positions of simulated arms from 1 s on"), std::string::npos);

  // Both arms reach through each other, in truth only.
  constexpr test::Pose kReaching{0, 0.3, 0, -1.8, 0, 2.1, 0.785};
  const double end_s = std::stod(truth.substr(truth.rfind('\n', truth.size() - 2) + 1));
  std::string row = std::to_string(end_s + 0.1);
  for (int arm = 0; arm < 2; ++arm) {
    for (const double q : kReaching) row += "," + std::to_string(q);
    row += ",0";
  }
  std::ofstream(recording / "true_states.csv", std::ios::app) << row << '\n';
  EXPECT_EQ(run(audit).exit_code, 1);
}

// The left arm faults just before its goal, and the right arm's job waits up to 10 min. The run
// ends when the cell has settled, records few states, and reports the jobs left over.
TEST_F(Simulate, EndsWhenSettledAndWritesNoIdleRows) {
  json jobs = json::parse(read_text_file(conflicting_jobs()).value());
  for (json& timed : jobs) timed["job"]["backlog_timeout_s"] = 600;
  const std::string faults =
      file("faults.json", R"([{"at_s": 2.98, "arm": "left", "kind": "fault"}])").string();
  const std::string recording = (folder_ / "recording").string();
  const Outcome outcome =
      run("simulate --cell " + kCell + " --jobs " + file("stuck.json", jobs.dump()).string() +
          " --faults " + faults + " --out " + recording);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("armloom: nothing can move any more at "), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("job j1 did not end; its state is queued, waits for stop left"),
            std::string::npos)
      << outcome.err;
  EXPECT_LT(fs::file_size(folder_ / "recording/states.csv"), 2'000'000U);
  EXPECT_EQ(outcome.err.find("all time limits have passed"), std::string::npos) << outcome.err;

  const std::string audit = "audit --cell " + kCell + " --recording " + recording;
  const Outcome whole = run(audit);
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(whole.err, "") << "no hole";
  fs::remove(folder_ / "recording/states_idle.csv");
  EXPECT_NE(run(audit).err.find("without a row"), std::string::npos);
}

TEST_F(Simulate, ReportsBadFaultsFilesWithPlaceAndValue) {
  const struct {
    const char* text;
    const char* says;
  } cases[] = {
      {"{}", "faults.json: expected an array"},
      {"[", "faults.json:/0: line 1"},
      {R"([{"arm": "left", "kind": "stall"}])", "faults.json:/0/at_s: "},
      {R"([{"at_s": 0, "arm": "middle", "kind": "stall"}])",
       "faults.json:/0/arm: the cell has no arm"},
      {R"([{"at_s": 0, "arm": "left", "kind": "hiccup"}])", "faults.json:/0/kind: "},
      {R"([{"at_s": 0, "arm": "left", "kind": "slow", "value": 2}])", "faults.json:/0/value: 2"},
      {R"([{"at_s": -1, "arm": "left", "kind": "stall"}])", "faults.json:/0/at_s: -1"},
  };
  const std::string jobs = conflicting_jobs().string();
  for (const auto& bad : cases) {
    const Outcome outcome = run("simulate --cell " + kCell + " --jobs " + jobs + " --faults " +
                                file("faults.json", bad.text).string());
    EXPECT_EQ(outcome.exit_code, 2) << bad.text;
    EXPECT_NE(outcome.err.find(bad.says), std::string::npos) << bad.text << outcome.err;
  }
  EXPECT_EQ(
      run("simulate --cell " + kCell + " --jobs " + jobs + " --faults nothing.json").exit_code, 2);
}

// The left arm's job has ended long before the run is given up; the right arm still moves.
TEST_F(Simulate, BusyRatioIsRelativeToTheRunEvenIfJobsDoNotEnd) {
  json jobs = json::array();
  for (const char* arm : {"left", "right"}) {
    test::Pose aside = test::kHome;
    aside[0] = 0.1;
    json job = test::move(arm, test::kHome, aside);
    job["backlog_timeout_s"] = 1;
    jobs.push_back({{"at", 0.0}, {"job", job}});
  }
  const Outcome outcome =
      run("simulate --cell " + kCell + " --jobs " + file("jobs.json", jobs.dump()).string() +
          " --faults " +
          file("faults.json", R"([{"at_s": 0, "arm": "right", "kind": "slow", "value": 0.01}])")
              .string());
  ASSERT_EQ(outcome.exit_code, 1) << outcome.err;
  const json figures = outcome.last_line();
  EXPECT_EQ(figures["jobs"]["running"], 1);
  EXPECT_LT(figures["makespan_s"], 4.0);
  EXPECT_GT(figures["arm_busy_ratio"]["right"], 0.95);
  EXPECT_LE(figures["arm_busy_ratio"]["right"], 1.0);
  EXPECT_LT(figures["arm_busy_ratio"]["left"], 0.1);
}

}  // namespace
}  // namespace armloom
