#include <gtest/gtest.h>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::RunningServer;

class MotionsOverHttp : public RunningServer {
 protected:
  void submit(const std::string& id, json job) {
    job["id"] = id;
    const auto answer = post("/api/v1/jobs", job.dump());
    ASSERT_EQ(answer.status, 202) << answer.body;
  }
  json motion(const std::string& id) {
    const auto answer = get("/api/v1/jobs/" + id + "/trajectory");
    EXPECT_EQ(answer.status, 200) << answer.body;
    return answer.json();
  }
};

void expect_same(const json& told, const json& posted) {
  ASSERT_EQ(told["joint_names"], posted["joint_names"]);
  ASSERT_EQ(told["points"].size(), posted["points"].size());
  for (std::size_t i = 0; i < told["points"].size(); ++i) {
    const json& a = told["points"][i];
    const json& b = posted["points"][i];
    EXPECT_NEAR(a["time_from_start"], b["time_from_start"], 1e-8);
    ASSERT_EQ(a.contains("accelerations"), b.contains("accelerations")) << i;
    for (const char* what : {"positions", "velocities", "accelerations"}) {
      if (!b.contains(what)) continue;
      for (std::size_t j = 0; j < 7; ++j) EXPECT_NEAR(a[what][j], b[what][j], 1e-7) << what << i;
    }
  }
}

TEST_F(MotionsOverHttp, TrajectoryOfAJobIsReturnedAsPosted) {
  start(1.0);
  const json quintic = test::move("left", test::kHome, test::kMiddle, 3.0, 5);
  json cubic = test::move("right", test::kHome, test::kHome, 2.0, 3);
  for (json& point : cubic["trajectory"]["points"]) point.erase("accelerations");
  cubic["trajectory"]["points"][1]["positions"][0] = 0.1;
  submit("quintic", quintic);
  submit("cubic", cubic);
  const json told = motion("quintic");
  EXPECT_EQ(told["id"], "quintic");
  EXPECT_EQ(told["duration_s"], 3.0);
  expect_same(told["trajectory"], quintic["trajectory"]);
  expect_same(motion("cubic")["trajectory"], cubic["trajectory"]);
  EXPECT_EQ(get("/api/v1/jobs/nothing/trajectory").status, 404);
}

TEST_F(MotionsOverHttp, RetimedTrajectoryCanBePostedAgain) {
  start(1.0);
  json path = test::move("left", test::kHome, test::kMiddle, 3.0, 4);
  for (json& point : path["trajectory"]["points"]) point = {{"positions", point["positions"]}};
  path["retime"] = true;
  submit("path", path);
  const json told = motion("path");
  EXPECT_GT(told["duration_s"], 0.1);
  // The other arm is at the equivalent start.
  std::string text = json{{"trajectory", told["trajectory"]}}.dump();
  for (std::size_t at = 0; (at = text.find("left_", at)) != std::string::npos;) {
    text.replace(at, 5, "right_");
  }
  const auto check = post("/api/v1/check", text);
  EXPECT_EQ(check.status, 200) << check.body;
}

TEST_F(MotionsOverHttp, StateFramesHaveProgressAndAuthority) {
  start(1.0);
  test::Listener listener(port());
  submit("there", test::move("left", test::kHome, test::kMiddle, 2.0));
  until(listener, "there", "running");
  json motions;
  while (motions.empty()) motions = listener.next_of("state")["motions"];
  ASSERT_EQ(motions.size(), 1U);
  EXPECT_EQ(motions[0]["arm"], "left");
  EXPECT_EQ(motions[0]["job"], "there");
  EXPECT_LE(motions[0]["progress_s"], motions[0]["authority_s"]);
  EXPECT_LE(motions[0]["authority_s"], 2.0);
  until(listener, "there", "succeeded");
  while (!motions.empty()) motions = listener.next_of("state")["motions"];
}

TEST_F(MotionsOverHttp, BackloggedJobsReportTheirTimeout) {
  options_.policy = "certified";
  start(1.0);
  test::Listener listener(port());
  submit("there", test::move("left", test::kHome, test::kMiddle, 5.0));
  until(listener, "there", "running");
  json second = test::move("right", test::kHome, test::kMiddle, 2.0);
  second["backlog_timeout_s"] = 40;
  submit("second", second);
  const json blocked = until(listener, "second", "backlogged");
  EXPECT_GE(blocked["backlogged_s"], blocked["submitted_s"]);
  EXPECT_NEAR(blocked["expires_s"], blocked["backlogged_s"].get<double>() + 40.0, 1e-6);
  EXPECT_FALSE(get("/api/v1/jobs/there").json().contains("expires_s"));
}

TEST_F(MotionsOverHttp, CellIsReportedAsSimulated) {
  start(1.0);
  EXPECT_EQ(get("/api/v1/cell").json()["simulated"], true);
}

}  // namespace
}  // namespace armloom
