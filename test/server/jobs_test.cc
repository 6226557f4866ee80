#include <gtest/gtest.h>

#include <set>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;

class Jobs : public test::RunningServer {
 protected:
  static std::string body(const std::string& id, const test::Pose& from, const test::Pose& to,
                          const std::string& arm = "left") {
    json job = test::move(arm, from, to);
    job["id"] = id;
    return job.dump();
  }
  // Follows the events until all of these jobs have ended; returns their last views by id.
  static std::map<std::string, json> until_ended(test::Listener& listener,
                                                 std::set<std::string> ids) {
    std::map<std::string, json> ended;
    while (!ids.empty()) {
      const json job = listener.next_of("job")["data"];
      if (job["result"].is_null() || ids.erase(job["id"]) == 0) continue;
      ended[job["id"]] = job;
    }
    return ended;
  }
};

TEST_F(Jobs, RunFromPostToSuccess) {
  start(20.0);
  test::Listener listener(port());
  const auto posted = post("/api/v1/jobs", body("go", test::kHome, test::kMiddle));
  ASSERT_EQ(posted.status, 202) << posted.body;
  EXPECT_EQ(posted.headers.at("location"), "/api/v1/jobs/go");
  EXPECT_EQ(posted.json()["duration_s"], 3.0);
  const json ended = until_ended(listener, {"go"})["go"];
  EXPECT_EQ(ended["state"], "succeeded") << ended;
  EXPECT_EQ(ended["result"]["reason"], "completed");
  EXPECT_EQ(ended["progress"], 1.0);
  EXPECT_GT(ended["ended_s"], ended["started_s"]);
  EXPECT_TRUE(ended["ended_at"].get<std::string>().ends_with("Z"));
  EXPECT_EQ(get("/api/v1/jobs/go").json(), ended);
  const json q = get("/api/v1/arms/left").json()["q"];
  for (std::size_t j = 0; j < 7; ++j) EXPECT_NEAR(q[j].get<double>(), test::kMiddle[j], 1e-3);
}

TEST_F(Jobs, ReportStoppingWhileACanceledJobBrakes) {
  start(1.0);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", body("long", test::kHome, test::kMiddle)).status, 202);
  while (listener.next_of("job")["data"]["state"] != "running") {
  }
  const auto canceled = test::request(port(), "DELETE", "/api/v1/jobs/long");
  EXPECT_EQ(canceled.status, 202) << canceled.body;
  EXPECT_EQ(canceled.json()["stopping"], true);
  EXPECT_TRUE(canceled.json()["result"].is_null());
  const json ended = until_ended(listener, {"long"})["long"];
  EXPECT_EQ(ended["state"], "canceled");
  EXPECT_EQ(ended["result"]["reason"], "canceled_by_client");
  EXPECT_EQ(ended["stopping"], false);
  EXPECT_LT(ended["progress"], 1.0);
  EXPECT_EQ(test::request(port(), "DELETE", "/api/v1/jobs/long").status, 409);
}

TEST_F(Jobs, ArePausedByStopAndFinishedAfterResume) {
  start(5.0);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", body("go", test::kHome, test::kMiddle)).status, 202);
  while (listener.next_of("job")["data"]["state"] != "running") {
  }
  const auto stopped = post("/api/v1/stop", "");
  EXPECT_EQ(stopped.status, 202);
  EXPECT_EQ(stopped.json()["stopped"], true);
  while (listener.next_of("job")["data"]["state"] != "paused") {
  }
  EXPECT_EQ(get("/api/v1/queue").json()["stopped"], true);
  EXPECT_EQ(get("/api/v1/queue").json()["running"][0]["id"], "go");
  EXPECT_EQ(post("/api/v1/resume", "").json()["stopped"], false);
  EXPECT_EQ(until_ended(listener, {"go"})["go"]["state"], "succeeded");
}

TEST_F(Jobs, AreListedNewestFirstInPages) {
  start(1.0);
  test::Pose from = test::kHome;
  test::Pose to = test::kMiddle;
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(post("/api/v1/jobs", body("j" + std::to_string(i), from, to)).status, 202);
    std::swap(from, to);
  }
  const json first = get("/api/v1/jobs?limit=2&arm=left").json();
  EXPECT_EQ(first["jobs"][0]["id"], "j4");
  EXPECT_EQ(first["jobs"][1]["id"], "j3");
  const json second =
      get("/api/v1/jobs?limit=3&cursor=" + first["next_cursor"].get<std::string>()).json();
  EXPECT_EQ(second["jobs"][0]["id"], "j2");
  EXPECT_EQ(second["jobs"].size(), 3U);
  EXPECT_TRUE(second["next_cursor"].is_null());
  EXPECT_EQ(get("/api/v1/jobs?arm=right").json()["jobs"], json::array());
  EXPECT_EQ(get("/api/v1/jobs?state=succeeded").json()["jobs"], json::array());
}

}  // namespace
}  // namespace armloom
