#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "server/durable/accepted_requests.h"
#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;

// Parameter: true with a data folder.
class Idempotency : public test::RunningServer, public ::testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    if (!GetParam()) return;
    std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::ranges::replace(name, '/', '-');
    options_.data = std::filesystem::path(::testing::TempDir()) / "armloom-resubmission" / name;
    std::filesystem::remove_all(*options_.data);
  }
  void restart(double speed = 1) {
    end();
    start(speed);
  }
  // Returns a job without motion, so that the next job can start at the same place.
  static json job(const std::string& id, const std::string& arm = "left") {
    json body = test::move(arm, test::kHome, test::kHome);
    if (!id.empty()) body["id"] = id;
    return body;
  }
  test::Answer send(const std::string& path, const json& body, const std::string& key = "") {
    const std::string header = key.empty() ? "" : "\r\nIdempotency-Key: " + key;
    return post("/api/v1" + path, body.dump(), "application/json" + header);
  }
  test::Answer send(const json& body, const std::string& key = "") {
    return send("/jobs", body, key);
  }
  std::size_t jobs_known() { return get("/api/v1/jobs?limit=1000").json()["jobs"].size(); }
};

TEST_P(Idempotency, SameIdAndBodyReturnTheSameJob) {
  start(1);
  const auto first = send(job("a"));
  ASSERT_EQ(first.status, 202) << first.body;
  const auto again = send(job("a"));
  EXPECT_EQ(again.status, 200) << again.body;
  EXPECT_EQ(again.json()["id"], "a");
  EXPECT_EQ(again.headers.at("location"), first.headers.at("location"));
  json other = job("a");
  other["priority"] = 1;
  const auto refused = send(other);
  EXPECT_EQ(refused.status, 409);
  EXPECT_EQ(refused.json()["pointer"], "/id");
  EXPECT_EQ(jobs_known(), 1U);
}

TEST_P(Idempotency, IgnoresWhitespaceAndMemberOrder) {
  start(1);
  const json body = job("a");
  ASSERT_EQ(send(body).status, 202);
  std::string spaced = "{\n \"id\": \"a\",\n \"trajectory\":" + body["trajectory"].dump(4) + "}";
  EXPECT_EQ(post("/api/v1/jobs", spaced).status, 200);
}

TEST_P(Idempotency, KeyIdentifiesOneRequest) {
  start(1);
  const auto first = send(job(""), "pick 7");
  ASSERT_EQ(first.status, 202) << first.body;
  const auto again = send(job(""), "pick 7");
  EXPECT_EQ(again.status, 200) << again.body;
  EXPECT_EQ(again.json()["id"], first.json()["id"]);
  EXPECT_EQ(again.headers.at("location"), first.headers.at("location"));
  const auto other = send(job("", "right"), "pick 7");
  EXPECT_EQ(other.status, 409);
  EXPECT_EQ(other.json()["pointer"], "Idempotency-Key");
  EXPECT_EQ(other.json()["value"], "pick 7");
  EXPECT_EQ(send(job(""), "pick 8").status, 202) << "another key is another request";
  EXPECT_EQ(send(job("")).status, 202) << "none, too";
  EXPECT_EQ(jobs_known(), 3U);
}

TEST_P(Idempotency, KeyFirstSentWithARetryIdentifiesOneRequest) {
  start(1);
  ASSERT_EQ(send(job("n1")).status, 202);
  const json batch = {{"jobs", {job("n1"), job("n2", "right")}}, {"atomic", false}};
  EXPECT_EQ(send("/batches", batch, "both").status, 207);
  const auto expect_bound = [&] {
    for (const std::string key : {"late", "later"}) {
      EXPECT_EQ(send(job("n1"), key).status, 200) << key;
      const auto other = send(job("n3"), key);
      EXPECT_EQ(other.status, 409) << other.body;
      EXPECT_EQ(other.json()["pointer"], "Idempotency-Key");
    }
    EXPECT_EQ(send("/batches", {{"jobs", {job("n1")}}}, "both").status, 409);
    EXPECT_EQ(jobs_known(), 2U);
  };
  expect_bound();
  if (!GetParam()) return;
  restart();
  expect_bound();
}

TEST_P(Idempotency, RefusedRequestDoesNotBindItsKey) {
  start(1);
  json bad = job("");
  bad["after"] = {"later"};
  ASSERT_EQ(send(bad, "k").status, 422);
  ASSERT_EQ(send(job("later")).status, 202);
  EXPECT_EQ(send(bad, "k").status, 202);
  EXPECT_EQ(send(bad, "k").status, 200);
}

TEST_P(Idempotency, KeyIsPrintableAndBounded) {
  start(1);
  EXPECT_EQ(send(job(""), std::string(255, 'k')).status, 202);
  for (const std::string& key : {std::string(256, 'k'), std::string("\xc3\xa4")}) {
    const auto refused = send(job(""), key);
    EXPECT_EQ(refused.status, 400);
    EXPECT_EQ(refused.json()["pointer"], "Idempotency-Key");
  }
}

TEST_P(Idempotency, BatchIsOneRequest) {
  start(1);
  const json batch = {{"jobs", {job(""), job("", "right"), job("c")}}};
  const auto first = send("/batches", batch, "b");
  ASSERT_EQ(first.status, 202) << first.body;
  const auto again = send("/batches", batch, "b");
  ASSERT_EQ(again.status, 200) << again.body;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.json()["jobs"][i]["id"], first.json()["jobs"][i]["id"]);
  }
  EXPECT_EQ(send("/batches", {{"jobs", {job("")}}}, "b").status, 409);
  EXPECT_EQ(send(job(""), "b").status, 409) << "nor is it a job's";
  const auto partly = send("/batches", {{"jobs", {job("d"), job("c")}}});
  EXPECT_EQ(partly.status, 409);
  EXPECT_EQ(partly.json()["pointer"], "/jobs/1");
  EXPECT_EQ(jobs_known(), 3U);
}

TEST_P(Idempotency, NonAtomicBatchRetriesRefusedJobs) {
  start(1);
  json late = job("late");
  late["after"] = {"first"};
  const json batch = {{"atomic", false}, {"jobs", {late, job("a"), job("", "right")}}};
  const auto results = [&] {
    const auto answer = send("/batches", batch, "b");
    EXPECT_EQ(answer.status, 207) << answer.body;
    return answer.json()["results"];
  };
  const json before = results();
  EXPECT_EQ(before[0]["status"], 422);
  ASSERT_EQ(send(job("first")).status, 202);
  const json now = results();
  for (const json& result : now) EXPECT_EQ(result["status"], 202) << result;
  EXPECT_EQ(now[2]["job"]["id"], before[2]["job"]["id"]);
  EXPECT_EQ(results()[0]["job"]["id"], "late");
  EXPECT_EQ(jobs_known(), 4U);
}

TEST_P(Idempotency, ConcurrentDuplicatesCreateOneJob) {
  start(1);
  const std::string text = test::request_text("POST", "/api/v1/jobs", job("").dump(),
                                              "application/json\r\nIdempotency-Key: twice");
  std::vector<std::unique_ptr<test::Wire>> wires;
  for (int i = 0; i < 8; ++i) wires.push_back(std::make_unique<test::Wire>(port()));
  for (const auto& wire : wires) wire->send(text);
  std::map<int, int> statuses;
  std::set<std::string> ids;
  for (const auto& wire : wires) {
    const auto answer = test::read_answer(*wire);
    ++statuses[answer.status];
    ids.insert(answer.json()["id"]);
  }
  EXPECT_EQ(statuses, (std::map<int, int>{{200, 7}, {202, 1}}));
  EXPECT_EQ(ids.size(), 1U);
}

TEST_P(Idempotency, SurvivesARestartWithADataFolder) {
  start(1);
  if (!GetParam()) {
    ASSERT_EQ(send(job("own"), "k").status, 202);
    restart();
    EXPECT_EQ(send(job("own"), "k").status, 202) << "nothing is kept without a data folder";
    return;
  }
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  const auto first = send(job(""), "k");
  ASSERT_EQ(send(job("own")).status, 202);
  const json batch = {{"jobs", {job(""), job("", "right")}}};
  const json both = send("/batches", batch, "b").json();
  restart(20);
  const auto again = send(job(""), "k");
  EXPECT_EQ(again.status, 200) << again.body;
  EXPECT_EQ(again.json()["id"], first.json()["id"]);
  EXPECT_EQ(again.json()["state"], "queued");
  EXPECT_EQ(send(job("own")).status, 200);
  EXPECT_EQ(send("/batches", batch, "b").json()["jobs"][1]["id"], both["jobs"][1]["id"]);
  EXPECT_EQ(send(job("", "right"), "k").status, 409);
  EXPECT_EQ(jobs_known(), 4U);

  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/resume", "").status, 202);
  until(listener, both["jobs"][0]["id"], "succeeded");
  restart();
  const auto ended = send(job(""), "k");
  EXPECT_EQ(ended.status, 200) << ended.body;
  EXPECT_EQ(ended.json()["state"], "succeeded") << "as it ended, and it is not run again";
  EXPECT_EQ(send(job("own")).json()["state"], "succeeded");
}

INSTANTIATE_TEST_SUITE_P(Jobs, Idempotency, ::testing::Bool(), [](const auto& suite) {
  return suite.param ? std::string("Kept") : std::string("InMemory");
});

TEST(AcceptedRequests, ForgetTheOldestBeyondTheBound) {
  AcceptedRequests requests(3);
  for (const char* name : {"a", "b", "c", "b", "d"}) requests.remember(name, {name, {{0, name}}});
  EXPECT_EQ(requests.find("a"), nullptr);
  for (const char* name : {"b", "c", "d"}) {
    ASSERT_NE(requests.find(name), nullptr);
    EXPECT_EQ(requests.find(name)->digest, name);
  }
}

TEST(AcceptedRequests, DuplicateWaitsForTheAnswerToTheFirst) {
  AcceptedRequests requests;
  int waited = 0;
  ASSERT_TRUE(requests.begin({"a", "b"}, nullptr));
  ASSERT_FALSE(requests.begin({"b", "c"}, [&] { ++waited; }));
  EXPECT_TRUE(requests.begin({"c"}, nullptr)) << "who waits holds nothing";
  requests.end({"a", "b"});
  EXPECT_EQ(waited, 1);
  EXPECT_TRUE(requests.begin({"b"}, nullptr));
}

}  // namespace
}  // namespace armloom
