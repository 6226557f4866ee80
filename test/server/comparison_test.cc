#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "server/comparison/jobs_at_hand.h"
#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;

class Comparing : public test::RunningServer {
 protected:
  static json there_and_back(const std::string& arm) {
    json job = test::move(arm, test::kHome, test::kMiddle, 3.0, 3);
    const json back = test::move(arm, test::kMiddle, test::kHome, 3.0, 3);
    for (std::size_t i = 1; i < 3; ++i) {
      json point = back["trajectory"]["points"][i];
      point["time_from_start"] = point["time_from_start"].get<double>() + 3.0;
      job["trajectory"]["points"].push_back(point);
    }
    job["id"] = arm;
    return job;
  }
  void submit(const json& job) {
    const auto answer = post("/api/v1/jobs", job.dump());
    ASSERT_EQ(answer.status, 202) << answer.body;
  }
  json ended() {
    for (;;) {
      const json now = get("/api/v1/comparison").json();
      if (now["state"] != "running") return now;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
};

TEST_F(Comparing, ReportsTheResultOfEachPolicy) {
  start(20.0);
  test::Listener listener(port());
  EXPECT_EQ(get("/api/v1/comparison").status, 404);
  EXPECT_EQ(post("/api/v1/comparison", "{}").status, 409) << "no job came yet";
  submit(there_and_back("left"));
  json behind = there_and_back("right");
  behind["after"] = {"left"};
  behind["id"] = "behind";
  submit(there_and_back("right"));
  submit(behind);
  until(listener, "behind", "succeeded");
  const auto begun =
      post("/api/v1/comparison", R"({"policies": ["sequential", "coordinated"], "seed": 3})");
  ASSERT_EQ(begun.status, 202) << begun.body;
  EXPECT_EQ(begun.json()["jobs"], 3);
  const json done = ended();
  ASSERT_EQ(done["state"], "done") << done;
  ASSERT_EQ(done["runs"].size(), 2U);
  const json& sequential = done["runs"][0];
  const json& coordinated = done["runs"][1];
  EXPECT_EQ(sequential["policy"], "sequential");
  EXPECT_EQ(sequential["succeeded"], 3) << done;
  EXPECT_EQ(coordinated["succeeded"], 3) << done;
  EXPECT_EQ(sequential["makespan_ratio"], 1.0);
  EXPECT_GE(sequential["makespan_s"].get<double>(), 18.0) << "three jobs of 6 s, one at a time";
  EXPECT_LT(coordinated["makespan_s"].get<double>(), sequential["makespan_s"].get<double>());
  EXPECT_NEAR(coordinated["makespan_ratio"].get<double>(),
              coordinated["makespan_s"].get<double>() / sequential["makespan_s"].get<double>(),
              1e-9);
  EXPECT_GT(coordinated["min_clearance_m"].get<double>(), 0.02);
  EXPECT_EQ(get("/api/v1/jobs").json()["jobs"].size(), 3U) << "nothing came to the cell";
}

TEST_F(Comparing, RunsOneComparisonAtATimeAndCanBeCanceled) {
  start(1.0);
  for (int i = 0; i < 30; ++i) {
    for (const char* arm : {"left", "right"}) {
      json job = there_and_back(arm);
      job["id"] = std::string(arm) + std::to_string(i);
      submit(job);
    }
  }
  ASSERT_EQ(post("/api/v1/comparison", "{}").status, 202);
  const auto second = post("/api/v1/comparison", "{}");
  EXPECT_EQ(second.status, 409) << second.body;
  EXPECT_EQ(second.json()["type"], "urn:armloom:problem:comparison-under-way");
  const auto canceled = remove("/api/v1/comparison");
  EXPECT_EQ(canceled.json()["state"], "canceled") << canceled.body;
  EXPECT_LT(canceled.json()["runs"].size(), 7U);
  EXPECT_EQ(post("/api/v1/comparison", R"({"policies": ["sequential"]})").status, 202);
  EXPECT_EQ(remove("/api/v1/comparison").status, 200);
}

TEST_F(Comparing, RefusesUnknownPoliciesAndEmptyJobLists) {
  start(20.0);
  submit(there_and_back("left"));
  const auto unknown = post("/api/v1/comparison", R"({"policies": ["hopeful"]})");
  EXPECT_EQ(unknown.status, 422);
  EXPECT_EQ(unknown.json()["pointer"], "/policies/0");
  const auto twice = post("/api/v1/comparison", R"({"policies": ["certified", "certified"]})");
  EXPECT_EQ(twice.status, 422);
  EXPECT_EQ(twice.json()["pointer"], "/policies/1");
  EXPECT_EQ(post("/api/v1/comparison", R"({"since_s": 1e6})").status, 409);
}

// The first job starts where the arm was before these jobs.
TEST_F(Comparing, StartsLaterJobsWhereTheirArmsWere) {
  start(50.0);
  test::Listener listener(port());
  json first = test::move("left", test::kHome, test::kMiddle);
  first["id"] = "first";
  submit(first);
  until(listener, "first", "succeeded");
  json second = test::move("left", test::kMiddle, test::kHome);
  second["id"] = "second";
  submit(second);
  const double since_s = get("/api/v1/jobs/second").json()["submitted_s"];
  ASSERT_EQ(
      post("/api/v1/comparison", json{{"since_s", since_s}, {"policies", {"certified"}}}.dump())
          .status,
      202);
  const json done = ended();
  EXPECT_EQ(done["jobs"], 1);
  EXPECT_EQ(done["runs"][0]["succeeded"], 1) << done;
}

TEST(JobsAtHand, DropsTheOldestBeyondItsBounds) {
  JobsAtHand at_hand(JobsAtHand::Bounds{3, 100});
  const auto note = [&](int i, std::size_t bytes) {
    at_hand.note({std::to_string(i), TimePoint(std::chrono::seconds(i)),
                  std::make_shared<const std::string>(bytes, ' ')});
  };
  for (int i = 0; i < 3; ++i) note(i, 10);
  EXPECT_TRUE(at_hand.since({}).whole);
  note(3, 10);
  auto taken = at_hand.since({});
  EXPECT_FALSE(taken.whole);
  ASSERT_EQ(taken.jobs.size(), 3U);
  EXPECT_EQ(taken.jobs.front().key, "1");
  note(4, 95);
  EXPECT_EQ(at_hand.since({}).jobs.size(), 1U) << "as many as fit";
  EXPECT_TRUE(at_hand.since(TimePoint(std::chrono::seconds(5))).jobs.empty());
}

}  // namespace
}  // namespace armloom
