// PATCH /jobs/{id}.
#include "test/server/verbs_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::kAside;

class Amending : public test::VerbsFixture {
 protected:
  test::Answer patch(const std::string& id, const json& body, const std::string& if_match = "") {
    const std::string text = body.dump();
    test::Wire wire(port());
    wire.send("PATCH /api/v1/jobs/" + id + " HTTP/1.1\r\nHost: 127.0.0.1\r\n" +
              "Content-Type: application/json\r\nContent-Length: " + std::to_string(text.size()) +
              (if_match.empty() ? "" : "\r\nIf-Match: " + if_match) + "\r\n\r\n" + text);
    return test::read_answer(wire);
  }
  std::string tag(const std::string& id) { return get("/api/v1/jobs/" + id).headers.at("etag"); }
  void submit(const std::string& id, const std::string& arm = "left") {
    ASSERT_EQ(post("/api/v1/jobs", job(id, test::kHome, kAside, arm).dump()).status, 202);
  }
};

TEST_F(Amending, ChangesOnlyTheGivenMembersAndPublishesThem) {
  start(1.0);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  submit("a");
  test::Listener listener(port());
  const auto changed = patch("a", {{"priority", 5}, {"backlog_timeout_s", 600}});
  ASSERT_EQ(changed.status, 200) << changed.body;
  EXPECT_EQ(changed.json()["priority"], 5);
  EXPECT_EQ(changed.json()["backlog_timeout_s"], 600);
  EXPECT_EQ(changed.json()["on_timeout"], "abort");
  next_job(listener, "a", [](const json& told) { return told["priority"] == 5; });
  const auto renamed = patch("a", {{"name", "the first"}, {"on_timeout", "replan"}});
  EXPECT_EQ(renamed.json()["name"], "the first");
  EXPECT_EQ(renamed.json()["on_timeout"], "replan");
  EXPECT_EQ(renamed.json()["priority"], 5);
  next_job(listener, "a", [](const json& told) { return told["name"] == "the first"; });
  EXPECT_EQ(get("/api/v1/jobs/a").json()["backlog_timeout_s"], 600);
  EXPECT_EQ(patch("a", json::object()).status, 200) << "nothing is to be changed";
}

TEST_F(Amending, SaysIfAPriorityChangesNothingBecauseTheBlockerHasStarted) {
  start(1.0);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", job("first", test::kHome, test::kMiddle).dump()).status, 202);
  until(listener, "first", "running");
  ASSERT_EQ(post("/api/v1/jobs", job("second", test::kHome, test::kMiddle, "right").dump()).status,
            202);
  until(listener, "second", "backlogged");
  const auto changed = patch("second", {{"priority", 5}});
  ASSERT_EQ(changed.status, 200) << changed.body;
  EXPECT_TRUE(changed.json()["notice"].get<std::string>().starts_with(
      "job second waits for job first, which has started: the priority changes nothing until"))
      << changed.body;
  EXPECT_FALSE(patch("second", {{"name", "b"}}).json().contains("notice"));
  EXPECT_FALSE(get("/api/v1/jobs/second").json().contains("notice"));
}

TEST_F(Amending, RefusesImpossibleChanges) {
  start(20.0);
  submit("a");
  expect_refused(patch("a", {{"priority", 2'000'000}}), 422, "/priority", 2'000'000);
  expect_refused(patch("a", {{"backlog_timeout_s", -1}}), 422, "/backlog_timeout_s", -1);
  EXPECT_EQ(patch("a", {{"id", "b"}}).status, 422);
  EXPECT_EQ(patch("a", {{"priority", "high"}}).status, 400);
  EXPECT_EQ(patch("nobody", {{"priority", 1}}).status, 404);
  test::Listener listener(port());
  if (get("/api/v1/jobs/a").json()["state"] != "succeeded") until(listener, "a", "succeeded");
  expect_refused(patch("a", {{"priority", 1}}), 409, "", "a");
  expect_refused(patch("a", {{"priority", 1}}, "\"old\""), 409, "", "a");
}

TEST_F(Amending, IfMatchRequiresTheLastChange) {
  start(1.0);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  submit("a");
  const std::string first = tag("a");
  const auto changed = patch("a", {{"priority", 5}}, first);
  ASSERT_EQ(changed.status, 200) << changed.body;
  const std::string second = changed.headers.at("etag");
  EXPECT_NE(second, first);
  expect_refused(patch("a", {{"priority", 6}}, first), 412, "If-Match", first);
  for (const char* command : {"DELETE /api/v1/jobs/a", "POST /api/v1/jobs/a/replan"}) {
    test::Wire wire(port());
    wire.send(std::string(command) +
              " HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 0\r\nIf-Match: " + first +
              "\r\n\r\n");
    expect_refused(test::read_answer(wire), 412, "If-Match", first);
  }
  EXPECT_EQ(get("/api/v1/jobs/a").json()["priority"], 5);
  EXPECT_EQ(patch("a", {{"priority", 6}}, "\"other\", " + second).status, 200);
  EXPECT_EQ(patch("a", {{"priority", 7}}, "W/" + tag("a")).status, 412) << "weak";
  EXPECT_EQ(patch("a", {{"priority", 7}}, "*").status, 200);
}

TEST_F(Amending, IfMatchIgnoresProgressOfTheJob) {
  start(1.0);
  submit("a");
  test::Listener listener(port());
  const std::string read = tag("a");
  while (get("/api/v1/jobs/a").json()["progress"] < 0.1) {
  }
  EXPECT_NE(tag("a"), read);
  EXPECT_EQ(patch("a", {{"priority", 2}}, read).status, 200);
}

TEST_F(Amending, CorsAllowsPatchAndIfMatch) {
  options_.allowed_origins = {"https://page.example"};
  start(1.0);
  test::Wire wire(port());
  wire.send(
      "OPTIONS /api/v1/jobs/a HTTP/1.1\r\nHost: 127.0.0.1\r\nOrigin: https://page.example\r\n\r\n");
  const auto allowed = test::read_answer(wire);
  EXPECT_NE(allowed.headers.at("access-control-allow-methods").find("PATCH"), std::string::npos);
  EXPECT_NE(allowed.headers.at("access-control-allow-headers").find("If-Match"), std::string::npos);
}

}  // namespace
}  // namespace armloom
