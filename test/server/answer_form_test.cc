// Forms of an answer: newline, ?pretty, text/plain, gzip; and what a reverse proxy needs.

#include <filesystem>
#include <fstream>

#include "test/server/unpacked.h"
#include "test/server/verbs_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::kAside;
using test::kHome;

class AnswerForm : public test::VerbsFixture {
 protected:
  test::Answer ask(const std::string& target, const std::string& fields,
                   const std::string& method = "GET") {
    test::Wire wire(port());
    wire.send(method + " /api/v1" + target + " HTTP/1.1\r\nHost: localhost\r\n" + fields +
              "Content-Length: 0\r\n\r\n");
    return test::read_answer(wire);
  }
};

TEST_F(AnswerForm, EndsWithANewlineAndIsIndentedIfAsked) {
  start(1.0);
  until_arm("left", "link", "up");  // the answers must not change
  for (const char* target : {"/api/v1/arms", "/api/v1/jobs/nobody", "/healthz", "/api/v1/queue"}) {
    const auto plain = get(target), pretty = get(std::string(target) + "?pretty");
    EXPECT_TRUE(plain.body.ends_with("}\n")) << target;
    EXPECT_EQ(pretty.json(), plain.json()) << target;
    EXPECT_TRUE(pretty.body.starts_with("{\n  \"")) << pretty.body;
    EXPECT_TRUE(pretty.body.ends_with("\n}\n")) << pretty.body;
  }
  EXPECT_EQ(get("/api/v1/queue?pretty=0").body, get("/api/v1/queue").body);
  expect_refused(get("/api/v1/queue?pretty=yes"), 400, "?pretty", "yes");
  EXPECT_EQ(test::request(port(), "POST", "/api/v1/stop?pretty").body,
            "{\n  \"stopped\": true,\n  \"category\": 2\n}\n");
}

TEST_F(AnswerForm, ExplainsThatALostControllerMustConnectFirst) {
  start(1.0);
  until_arm("left", "link", "up");
  ASSERT_EQ(post("/api/v1/sim/faults", R"({"arm": "left", "kind": "cut"})").status, 201);
  until_arm("left", "state", "stopped");
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", job("wave", kHome, kAside).dump()).status, 202);
  next_job(listener, "wave", [](const json& told) { return !told["waits_on"].empty(); });
  const std::string why = ask("/jobs/wave", "Accept: text/plain\r\n").body;
  EXPECT_NE(why.find("the controller of arm left to connect again"), std::string::npos) << why;
  EXPECT_NE(why.find(" Start the controller of arm left again, or repair its connection. If an arm "
                     "is still stopped when its link is up: POST /api/v1/resume"),
            std::string::npos)
      << why;
  ASSERT_EQ(remove("/api/v1/sim/faults/1").status, 204);
  until_arm("left", "link", "up");
  EXPECT_NE(ask("/jobs/wave", "Accept: text/plain\r\n").body.find("for arm left to be resumed. "),
            std::string::npos);
}

TEST_F(AnswerForm, ExplainsWhyAJobWithoutALinkNeitherMovesNorEnds) {
  const std::string as_text = "Accept: text/plain\r\n";
  start(1.0);
  until_arm("left", "link", "up");
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", job("wave", kHome, kAside, "left", 20.0).dump()).status, 202);
  next_job(listener, "wave", [](const json& told) { return told["state"] == "running"; });
  ASSERT_EQ(post("/api/v1/sim/faults", R"({"arm": "left", "kind": "drop_feedback"})").status, 201);
  until_arm("left", "link", "lost");
  until_arm("left", "state", "stopped");
  const std::string why = ask("/jobs/wave", as_text).body;
  for (const char* words : {"It waits for the controller of arm left to connect again, and for the "
                            "arm to be resumed. (link lost: ",
                            " Start the controller of arm left again, or repair its connection",
                            "POST /api/v1/resume"}) {
    EXPECT_NE(why.find(words), std::string::npos) << words << ": " << why;
  }
  EXPECT_EQ(why.find("brakes on its path"), std::string::npos) << "nobody knows: " << why;
  const std::string canceled = ask("/jobs/wave", as_text, "DELETE").body;
  for (const std::string& text : {canceled, ask("/jobs/wave", as_text).body}) {
    EXPECT_NE(text.find(" It ends when its controller reports again. Start the controller of arm "
                        "left again, or repair its connection ("),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("resume"), std::string::npos) << "it has no more to do: " << text;
  }
  ASSERT_EQ(remove("/api/v1/sim/faults/1").status, 204);
  next_job(listener, "wave", [](const json& told) { return !told["result"].is_null(); });
}

TEST_F(AnswerForm, ArmsNameTheirStopAndTheirLink) {
  const std::string as_text = "Accept: text/plain\r\n";
  start(1.0);
  until_arm("left", "link", "up");
  EXPECT_NE(ask("/arms/right/stop", as_text, "POST").body.find("  stopped: operator\n"),
            std::string::npos);
  ASSERT_EQ(post("/api/v1/sim/faults", R"({"arm": "left", "kind": "cut"})").status, 201);
  until_arm("left", "state", "stopped");
  const std::string arms = ask("/arms", as_text).body;
  EXPECT_TRUE(arms.substr(0, arms.find('\n')).ends_with("  NOTE")) << arms;
  EXPECT_NE(arms.find("  stopped: link lost: "), std::string::npos) << arms;
  EXPECT_NE(arms.find("; link lost: "), std::string::npos) << arms;
  EXPECT_NE(arms.find("  stopped: operator\n"), std::string::npos) << arms;
  const std::string stopped = ask("/stop", as_text, "POST").body;
  EXPECT_NE(
      stopped.find("\narm left gets no command, because there is no link to its controller ("),
      std::string::npos)
      << stopped;
}

TEST_F(AnswerForm, ExplainsThatAControllerMustBeStarted) {
  const std::filesystem::path top = source_dir();
  json cell = json::parse(read_text_file(top / "config/two_pandas_remote.json").value(), nullptr,
                          true, true);
  for (json& robot : cell["robots"]) {
    robot["urdf"] = (top / "models/panda.urdf").string();
    robot["srdf"] = (top / "models/panda.srdf").string();
    robot["controller"]["endpoint"] = "unix:/none/" + robot["name"].get<std::string>();
  }
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "unstarted.json";
  std::ofstream(file) << cell;
  start(1.0, {}, file);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", job("wave", kHome, kAside).dump()).status, 202);
  next_job(listener, "wave", [](const json& told) { return !told["waits_on"].empty(); });
  const std::string why = ask("/jobs/wave", "Accept: text/plain\r\n").body;
  EXPECT_NE(why.find("It waits for the controller of arm left to connect."), std::string::npos)
      << why;
  EXPECT_NE(why.find("no answer from unix:/none/left"), std::string::npos) << why;
  EXPECT_NE(why.find(" Start the controller of arm left"), std::string::npos) << why;
}

TEST_F(AnswerForm, IsTextIfTheClientPrefersIt) {
  start(1.0);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", job("wave", kHome, kAside).dump()).status, 202);
  next_job(listener, "wave", [](const json& told) { return !told["waits_on"].empty(); });
  const std::string text = "Accept: text/plain\r\n";
  const auto why = ask("/jobs/wave", text);
  EXPECT_EQ(why.headers.at("content-type"), "text/plain; charset=utf-8");
  EXPECT_TRUE(why.body.starts_with("Job wave of arm left is ")) << why.body;
  EXPECT_NE(why.body.find("It waits for arm left to be resumed."), std::string::npos) << why.body;
  EXPECT_NE(why.body.find("POST /api/v1/resume"), std::string::npos) << why.body;
  EXPECT_EQ(std::ranges::count(why.body, '\n'), 1) << "one paragraph";
  EXPECT_TRUE(ask("/jobs", text).body.starts_with("JOB ")) << "a table";
  EXPECT_TRUE(
      ask("/queue", text).body.starts_with("policy earliest_start, all arms are stopped\n"));
  EXPECT_EQ(std::ranges::count(ask("/arms", text).body, '\n'), 3);
  EXPECT_EQ(ask("/stop?category=0", text, "POST").body,
            "all arms switch their drives off, each joint brakes by itself, and moving arms leave "
            "their paths; they stay stopped until resumed\n");
  EXPECT_EQ(ask("/stop", text, "POST").body,
            "all arms brake on their paths, then hold their positions; they stay stopped until "
            "resumed\n");
  EXPECT_EQ(ask("/jobs/wavy", text).body, "no such job \"wavy\"; did you mean wave?\n");
  EXPECT_EQ(ask("/arms/lfet/stop", text, "POST").body,
            "no such arm \"lfet\"; did you mean left?\n");
  for (const char* accept : {"application/json, text/plain, */*", "*/*", "text/plain;q=0",
                             "text/*;q=0.2, application/json;q=0.3"}) {
    const auto answer = ask("/jobs/wave", std::string("Accept: ") + accept + "\r\n");
    EXPECT_EQ(answer.headers.at("content-type"), "application/json") << accept;
    EXPECT_EQ(answer.headers.at("vary"), "Accept, Accept-Encoding");
  }
}

TEST_F(AnswerForm, IsCompressedAboveOneKilobyte) {
  start(1.0);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  test::Listener listener(port());
  const std::string id(100, 'x');
  for (int i = 0; i < 5; ++i) {
    json body = job(id + std::to_string(i), kHome, kHome);
    body["name"] = std::string(250, 'n');
    ASSERT_EQ(post("/api/v1/jobs", body.dump()).status, 202);
  }
  const std::string gzip = "Accept-Encoding: gzip\r\n";
  const auto packed = ask("/jobs?state=queued&arm=right", gzip), jobs = ask("/jobs", gzip);
  EXPECT_EQ(packed.headers.count("content-encoding"), 0U) << "small";
  EXPECT_EQ(jobs.headers.at("content-encoding"), "gzip");
  EXPECT_EQ(json::parse(test::unpacked(jobs.body))["jobs"].size(), 5U);
  EXPECT_EQ(ask("/jobs", "").headers.count("content-encoding"), 0U);

  next_job(listener, id + "4", [](const json& told) { return !told["waits_on"].empty(); });
  const std::string one = "/jobs/" + id + "4", big = one + "?pretty";
  const auto shown = ask(big, gzip);
  const std::string tag = shown.headers.at("etag");
  ASSERT_TRUE(tag.ends_with("-pretty-gzip\"")) << tag << test::unpacked(shown.body);
  test::Wire wire(port());
  wire.send("GET /api/v1" + big + " HTTP/1.1\r\nHost: localhost\r\n" + gzip +
            "If-None-Match: " + tag + "\r\n\r\n");
  EXPECT_EQ(test::read_answer(wire, true).status, 304);
  EXPECT_EQ(ask(big, "If-None-Match: " + tag + "\r\n").status, 200) << "another form";
  EXPECT_EQ(ask(one, "If-Match: " + tag + "\r\n", "DELETE").status, 202) << "the same job";
}

TEST_F(AnswerForm, LocatesBelowThePathOfAReverseProxy) {
  start(1.0);
  const auto located = [this](const std::string& prefix) {
    const std::string body = job("", kHome, kHome).dump();
    test::Wire wire(port());
    wire.send(
        "POST /api/v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n" +
        prefix + "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    return test::read_answer(wire);
  };
  for (const char* bad :
       {"cell7", "//evil.example", "/a b", "/a?b", "/a/../b", "/\"", "http://a/"}) {
    const auto answer = located(std::string("X-Forwarded-Prefix: ") + bad + "\r\n");
    expect_refused(answer, 400, "X-Forwarded-Prefix", bad);
  }
  json body = job("one", kHome, kHome);
  test::Wire wire(port());
  const std::string text = body.dump();
  wire.send(
      "POST /api/v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
      "X-Forwarded-Prefix: /cells/7/\r\nContent-Length: " +
      std::to_string(text.size()) + "\r\n\r\n" + text);
  const auto answer = test::read_answer(wire);
  EXPECT_EQ(answer.status, 202) << answer.body;
  EXPECT_EQ(answer.headers.at("location"), "/cells/7/api/v1/jobs/one");
  test::Wire events(port());
  events.send("GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\nAccept-Encoding: gzip\r\n\r\n");
  const std::string head = events.take_until("\r\n\r\n");
  EXPECT_NE(head.find("X-Accel-Buffering: no\r\n"), std::string::npos) << head;
  EXPECT_EQ(head.find("Content-Encoding"), std::string::npos) << head;
}

TEST_F(AnswerForm, RefusesRepeatedFieldsByName) {
  start(1.0);
  for (const char* name :
       {"Content-Type", "Content-Encoding", "Authorization", "Origin", "Idempotency-Key",
        "If-Match", "If-None-Match", "Last-Event-ID", "X-Request-Id", "X-Forwarded-Prefix"}) {
    const std::string field = std::string(name) + ": a\r\n";
    const auto answer = ask("/arms", field + field);
    EXPECT_EQ(answer.status, 400) << name;
    EXPECT_EQ(answer.json()["pointer"], name) << answer.body;
    EXPECT_EQ(answer.json().contains("value"), std::string(name) != "Authorization");
  }
  EXPECT_EQ(ask("/arms", "X-Other: a\r\n b\r\n").json()["pointer"], "X-Other") << "obs-fold";
  const auto foreign = ask("/stop", "Origin: https://evil.example\r\n", "POST");
  EXPECT_EQ(foreign.status, 403);
  EXPECT_NE(foreign.body.find("--allow-origin https://evil.example"), std::string::npos);
}

}  // namespace
}  // namespace armloom
