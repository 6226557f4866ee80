#include "test/server/verbs_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::kAside;

class Batches : public test::VerbsFixture {};

TEST_F(Batches, RunInOrder) {
  start(20.0);
  test::Listener listener(port());
  json there = job("there", test::kHome, test::kMiddle);
  json back = job("back", test::kMiddle, test::kHome);
  json other = job("other", test::kHome, kAside, "right");
  other["after"] = {"there"};
  const auto answer =
      post("/api/v1/batches", json({{"jobs", {there, back, other}}, {"atomic", true}}).dump());
  ASSERT_EQ(answer.status, 202) << answer.body;
  EXPECT_EQ(answer.json()["jobs"][2]["id"], "other");
  const json ended_there = until(listener, "there", "succeeded");
  const json begun = until(listener, "other", "running");
  EXPECT_GE(begun["started_s"], ended_there["ended_s"]);
}

TEST_F(Batches, StoreNothingIfAtomicWithOneBadJob) {
  start(1.0);
  json bad = job("bad", test::kMiddle, test::kHome);
  bad["trajectory"]["points"][3]["velocities"][1] = 3.41;
  const json batch = {{"jobs", {job("good", test::kHome, test::kMiddle), bad}}};
  expect_refused(post("/api/v1/batches", batch.dump()), 422,
                 "/jobs/1/trajectory/points/3/velocities/1", 3.41);
  bad["trajectory"] = 7;
  const json unreadable = {{"jobs", {job("good", test::kHome, test::kMiddle), bad}}};
  expect_refused(post("/api/v1/batches", unreadable.dump()), 400, "/jobs/1/trajectory", 7);
  const json twice = {
      {"jobs", {job("a", test::kHome, test::kMiddle), job("a", test::kMiddle, test::kHome)}}};
  expect_refused(post("/api/v1/batches", twice.dump()), 409, "/jobs/1/id", "a");
  EXPECT_EQ(jobs_stored(), 0U);
}

TEST_F(Batches, AnswerEachJobInItsPlaceIfNotAtomic) {
  start(1.0);
  json unreadable = job("x", test::kHome, test::kMiddle);
  unreadable["priority"] = "high";
  const json batch = {{"atomic", false},
                      {"jobs",
                       {unreadable, job("a", test::kHome, test::kMiddle),
                        job("astray", test::kHome, test::kMiddle)}}};
  const auto answer = post("/api/v1/batches", batch.dump());
  ASSERT_EQ(answer.status, 207) << answer.body;
  const json results = answer.json()["results"];
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0]["status"], 400);
  EXPECT_EQ(results[0]["problem"]["pointer"], "/priority");
  EXPECT_EQ(results[1]["status"], 202);
  EXPECT_EQ(results[1]["job"]["id"], "a");
  EXPECT_EQ(results[2]["status"], 422);  // the arm will not be there
  EXPECT_EQ(results[2]["problem"]["value"], test::kHome[1]);
  EXPECT_EQ(jobs_stored(), 1U);
}

TEST_F(Batches, AreBoundedAndNotEmpty) {
  start(1.0);
  expect_refused(post("/api/v1/batches", R"({"jobs": []})"), 422, "/jobs", "array of 0");
  const json many = {{"jobs", std::vector<json>(1001, json::object())}};
  expect_refused(post("/api/v1/batches", many.dump()), 413, "/jobs", "array of 1001");
  expect_refused(post("/api/v1/batches", R"({"jobs": [{}], "all": 1})"), 422, "/all", 1);
  expect_refused(post("/api/v1/batches", R"({"jobs": [{}], "atomic": 1})"), 400, "/atomic", 1);
}

TEST_F(Batches, CheckReportsTheVerdictOfAdmissionAndStoresNothing) {
  start(20.0);
  test::Listener listener(port());
  const json free =
      post("/api/v1/check", job("x", test::kHome, test::kMiddle, "right").dump()).json();
  EXPECT_EQ(free["verdict"], "free");
  EXPECT_EQ(free["earliest_start_s"], 0.0);
  EXPECT_EQ(free["conflicts"], json::array());
  EXPECT_GT(free["evaluations"], 0);
  EXPECT_EQ(jobs_stored(), 0U);

  ASSERT_EQ(post("/api/v1/jobs", job("l", test::kHome, test::kMiddle).dump()).status, 202);
  until(listener, "l", "succeeded");
  // The left arm rests in the way now, but would retreat.
  const json later =
      post("/api/v1/check", job("x", test::kHome, test::kMiddle, "right").dump()).json();
  EXPECT_EQ(later["verdict"], "free");
  EXPECT_TRUE(later["earliest_start_s"].is_number());
  EXPECT_EQ(later["conflicts"], json::array());
  EXPECT_TRUE(later["waits_on"].is_array());
  ASSERT_EQ(post("/api/v1/arms/left/stop", "").status, 202);  // a stopped arm does not retreat
  const json conflict =
      post("/api/v1/check", job("x", test::kHome, test::kMiddle, "right").dump()).json();
  EXPECT_EQ(conflict["verdict"], "conflict");
  EXPECT_TRUE(conflict["earliest_start_s"].is_null());
  ASSERT_EQ(conflict["conflicts"].size(), 1U) << conflict;
  EXPECT_EQ(conflict["conflicts"][0]["kind"], "arm");
  EXPECT_EQ(conflict["conflicts"][0]["arm"], "left");
  EXPECT_EQ(conflict["conflicts"][0]["links"].size(), 2U);
  EXPECT_EQ(jobs_stored(), 1U);

  json bad = job("y", test::kHome, test::kMiddle, "right");
  bad["trajectory"]["joint_names"][2] = "elbow";
  expect_refused(post("/api/v1/check", bad.dump()), 422, "/trajectory/joint_names/2", "elbow");
}

}  // namespace
}  // namespace armloom
