#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "server/codec/read_text.h"
#include "server/codec/stream_id.h"
#include "server/messages/events.h"
#include "server/messages/job.h"
#include "server/messages/plain_text.h"
#include "server/messages/problem.h"

namespace armloom {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

JobView waiting_job() {
  JobView job;
  job.key = "b";
  job.state = JobState::backlogged;
  job.arms = {"right"};
  job.times.submitted_at = at(milliseconds(1500));
  job.motion.duration = milliseconds(3000);
  job.waits_on.push_back(
      WaitView{Wait::Kind::job, "a", "left", {"r7", "l7"}, 1.25, 0.5, 0.004, ""});
  return job;
}

TEST(Views, WaitingJobReportsItsBlocker) {
  const WallClock clock(std::chrono::system_clock::time_point{}, 2.0);
  const json job = json::parse(text_of(*job_format(), waiting_job(), &clock));
  EXPECT_EQ(job["id"], "b");
  EXPECT_EQ(job["state"], "backlogged");
  EXPECT_EQ(job["submitted_s"], 1.5);
  EXPECT_EQ(job["submitted_at"], "1970-01-01T00:00:00.750Z");  // the cell runs twice as fast
  EXPECT_TRUE(job["started_s"].is_null());
  EXPECT_TRUE(job["started_at"].is_null());
  EXPECT_TRUE(job["result"].is_null());
  const json expected = {{"kind", "job"},         {"id", "a"},          {"arm", "left"},
                         {"links", {"r7", "l7"}}, {"own_time_s", 1.25}, {"other_time_s", 0.5},
                         {"clearance_m", 0.004}};
  EXPECT_EQ(job["waits_on"], json::array({expected}));
  EXPECT_EQ(job["cycle"], json::array());
}

TEST(Views, DeadlockedJobReportsItsCycle) {
  JobView job = waiting_job();
  job.cycle = {"b", "a"};
  EXPECT_EQ(json::parse(text_of(*job_format(), job))["cycle"], json({"b", "a"}));
}

TEST(Views, EndedJobReportsItsReason) {
  JobView job = waiting_job();
  job.waits_on.clear();
  job.state = JobState::expired;
  job.result = {Reason::backlog_timeout, "waited 60 s"};
  const json result = json::parse(text_of(*job_format(), job));
  EXPECT_EQ(result["result"], json({{"reason", "backlog_timeout"}, {"detail", "waited 60 s"}}));
  EXPECT_FALSE(result.contains("submitted_at"));
}

TEST(Views, SimulatedEventHasNoWallTime) {
  const Event event{7, at(milliseconds(26682)), Alert{Alert::Level::warning, "x"}};
  EXPECT_EQ(event_json(event, "s", nullptr), R"({"stream":"s","seq":7,"type":"alert","t_s":26.682,)"
                                             R"("data":{"level":"warning","text":"x"}})");
}

json ended_by(const char* reason, double ended_s) {
  return {{"id", "a"},
          {"state", "interrupted"},
          {"arms", {"left"}},
          {"started_s", 1.0},
          {"ended_s", ended_s},
          {"ended_at", "2026-11-23T15:04:05.678Z"},
          {"result", {{"reason", reason}, {"detail", "it ended"}}}};
}

TEST(Texts, JobThatALaterSessionEndedHasNoDuration) {
  const std::string begin = "Job a of arm left ended as interrupted at 2026-11-23T15:04:05.678Z: ";
  EXPECT_EQ(job_text(ended_by("canceled", 3.5), {}),
            begin + "canceled, it ended. It took 2.5 s from its start to its end.\n");
  EXPECT_EQ(job_text(ended_by("server_restart", 3.5), {}),
            begin + "server_restart, it ended. It took 2.5 s from its start to its end.\n");
  EXPECT_EQ(job_text(ended_by("server_restart", 1.0), {}),
            begin + "server_restart, it ended. The server did not see when it came to rest.\n");
}

TEST(Texts, MonitorEventShowsItsFinding) {
  MonitorEvent found;
  found.text = "left_panda_joint1 is 0.02 rad off its path, limit 0.001 rad";
  found.arms = found.stopped = {"left"};
  found.finding.kind = MonitorFinding::Kind::deviation;
  const Event event{7, at(milliseconds(2500)), found};
  EXPECT_EQ(event_text(json::parse(event_json(event, "s", nullptr))),
            "     2.500  monitor  left_panda_joint1 is 0.02 rad off its path, limit 0.001 rad; "
            "stopped: left\n");
}

TEST(Texts, FaultWithoutAValueShowsADash) {
  const json stall = {{"id", "1"}, {"arm", "left"}, {"kind", "stall"}, {"value", 0.0}};
  EXPECT_EQ(fault_text(stall, {}),
            "FAULT  ARM   KIND   VALUE  STARTS  REMAINING\n"
            "1      left  stall  -      now     -\n");
  const json slow = {{"id", "2"}, {"arm", "left"}, {"kind", "slow"}, {"value", 0.0}};
  EXPECT_NE(fault_text(slow, {}).find("  slow  0  "), std::string::npos);
}

TEST(Problems, AreWrittenAsDocumentsAndSentences) {
  const Problems problems{{ProblemKind::invalid, "limit-exceeded",
                           "/trajectory/points/14/velocities/3", "too fast", 3.41},
                          {ProblemKind::invalid, "x", "/y", "z", {}}};
  const json document = json::parse(problem_json(problems));
  EXPECT_EQ(document["status"], 422);
  EXPECT_EQ(document["type"], "urn:armloom:problem:limit-exceeded");
  EXPECT_EQ(document["title"], "Limit exceeded");
  EXPECT_EQ(document["pointer"], "/trajectory/points/14/velocities/3");
  EXPECT_EQ(document["value"], 3.41);
  EXPECT_EQ(document["errors"].size(), 2U);
  EXPECT_FALSE(json::parse(problem_json({problems[1]})).contains("errors"));
  EXPECT_EQ(problem_sentence("cell.json", problems[0]),
            "cell.json:/trajectory/points/14/velocities/3: too fast (found 3.41)");
  EXPECT_EQ(
      problem_sentence("cell.json", {ProblemKind::invalid, "x", "a.urdf: joint b", "bad", {}}),
      "a.urdf: joint b: bad");
}

}  // namespace
}  // namespace armloom
