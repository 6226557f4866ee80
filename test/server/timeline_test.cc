#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::RunningServer;

constexpr double kAtMost_s = 0.2;  // accepted difference between prediction and outcome
constexpr double kPauseLoss_s = 0.3;

class TimelineOverHttp : public RunningServer {
 protected:
  void submit(const std::string& id, json job) {
    job["id"] = id;
    const auto answer = post("/api/v1/jobs", job.dump());
    ASSERT_EQ(answer.status, 202) << answer.body;
  }
  json timeline() {
    const auto answer = get("/api/v1/timeline");
    EXPECT_EQ(answer.status, 200) << answer.body;
    return answer.json();
  }
};

TEST_F(TimelineOverHttp, ListsEveryArmOfACellAtRest) {
  start(1.0);
  const json told = timeline();
  ASSERT_EQ(told["arms"].size(), 2U);
  for (const std::size_t arm : {0U, 1U}) {
    EXPECT_EQ(told["arms"][arm]["name"], arm == 0 ? "left" : "right");
    EXPECT_TRUE(told["arms"][arm]["steps"].empty());
    EXPECT_EQ(told["arms"][arm]["waiting"], 0);
  }
}

// Both jobs end in the middle: one arm goes there and back, the other waits for it.
TEST_F(TimelineOverHttp, PredictsTheStartAndTheBlockerOfAJob) {
  options_.policy = "coordinated";
  start(1.0);
  test::Listener listener(port());
  submit("l", test::move("left", test::kHome, test::kMiddle, 2.0));
  submit("l-back", test::move("left", test::kMiddle, test::kHome, 2.0));
  until(listener, "l", "running");
  submit("r", test::move("right", test::kHome, test::kMiddle, 3.0));
  json told = timeline();
  // until the job has been checked and admitted
  while (told["arms"][1]["steps"].empty()) told = timeline();
  const json leg = told["arms"][1]["steps"][0];
  EXPECT_EQ(leg["id"], "r");
  EXPECT_EQ(leg["arms"], json::array({"right"}));
  ASSERT_FALSE(leg["pauses"].empty()) << told;
  const json pause = leg["pauses"].back();
  EXPECT_EQ(pause["waits_on"]["kind"], "job");
  EXPECT_TRUE(pause["waits_on"]["id"] == "l" || pause["waits_on"]["id"] == "l-back") << pause;
  EXPECT_EQ(pause["waits_on"]["arm"], "left");
  EXPECT_EQ(pause["waits_on"]["links"].size(), 2U);
  const json came = until(listener, "r", "succeeded");
  EXPECT_NEAR(leg["starts_s"], came["started_s"], kAtMost_s);
  // The prediction counts kPauseLoss_s for a pause on the path; the real loss may be less.
  const double late_s = leg["ends_s"].get<double>() - came["ended_s"].get<double>();
  EXPECT_GE(late_s, -kAtMost_s);
  EXPECT_LE(late_s, (pause["at_s"] > 0.0 ? kPauseLoss_s : 0.0) + kAtMost_s);
  const json first = told["arms"][0]["steps"].back();
  const json back = get("/api/v1/jobs/l-back").json();
  EXPECT_EQ(first["id"], "l-back");
  EXPECT_NEAR(first["starts_s"], back["started_s"], kAtMost_s);
  EXPECT_NEAR(first["ends_s"], back["ended_s"], kAtMost_s);
}

}  // namespace
}  // namespace armloom
