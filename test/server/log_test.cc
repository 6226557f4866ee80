#include <gtest/gtest.h>

#include <mutex>

#include "server/http/request_id.h"
#include "server/log/log_line.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;

const LogLine kHostile{LogLine::Level::warning,
                       "stopped by \"Eve\"\n[error] all is lost\x1b[2J",
                       {{"path", "/jobs/a b\r\n\xff"}, {"status", std::int64_t{404}}, {"ms", 1.5}}};

TEST(LogLine, EscapesLineBreaksAndTerminalControls) {
  const std::string text = text_of(kHostile);
  for (const char c : text) EXPECT_TRUE(static_cast<unsigned char>(c) >= ' ' && c != 0x7f) << text;
  EXPECT_NE(text.find(R"(path="/jobs/a b\u000d\n)"), std::string::npos) << text;
  EXPECT_NE(text.find(" status=404 ms=1.5"), std::string::npos) << text;
  EXPECT_EQ(text_of({LogLine::Level::info, "serving", {{"cell", "two_pandas"}, {"policy", ""}}}),
            "serving cell=two_pandas policy=\"\"");
}

// Control characters beyond ASCII must be escaped, too: C1 controls, line separators, bidirectional
// marks.
TEST(LogLine, EscapesUnicodeControlsButNotLetters) {
  const LogLine line{LogLine::Level::info,
                     "asked",
                     {{"path", "/\u202eevil\u009b31m\u0085\u2028\u2066x"}, {"name", "größe € 腕"}}};
  EXPECT_EQ(text_of(line),
            R"(asked path="/\u202eevil\u009b31m\u0085\u2028\u2066x" name="größe € 腕")");
  const std::string text = json_of(line, {});
  EXPECT_NE(text.find(R"(\u202eevil\u009b31m)"), std::string::npos) << text;
  EXPECT_EQ(json::parse(text)["path"], "/\u202eevil\u009b31m\u0085\u2028\u2066x");
  EXPECT_EQ(json::parse(text)["name"], "größe € 腕");
}

TEST(LogLine, IsOneJsonObjectOnOneLine) {
  using std::chrono::milliseconds;
  const std::string text =
      json_of(kHostile, std::chrono::system_clock::time_point(milliseconds(1500)));
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const json line = json::parse(text);
  EXPECT_EQ(line["at"], "1970-01-01T00:00:01.500Z");
  EXPECT_EQ(line["level"], "warning");
  EXPECT_EQ(line["message"], kHostile.message);
  EXPECT_EQ(line["status"], 404);
}

class RequestLog : public test::RunningServer {
 protected:
  void begin(LoggedRequests which) {
    options_.logged_requests = which;
    options_.log = [this](const LogLine& line) {
      const std::scoped_lock lock(mutex_);
      lines_.push_back(json::parse(json_of(line, std::chrono::system_clock::now())));
    };
    start(1.0);
  }
  std::string answer_to(const std::string& bytes) {
    test::Wire wire(port());
    wire.send(bytes);
    return wire.take_all();
  }
  std::vector<json> requests() {
    const std::scoped_lock lock(mutex_);
    std::vector<json> found;
    for (const json& line : lines_) {
      if (line["message"] == "request") found.push_back(line);
    }
    return found;
  }
  std::vector<json> lines_;
  std::mutex mutex_;
};

TEST_F(RequestLog, RecordsCommandsWithTheirRequestId) {
  begin(LoggedRequests::commands);
  EXPECT_EQ(get("/api/v1/queue").status, 200);
  const auto stopped = post("/api/v1/stop", "");
  const auto found = requests();
  ASSERT_EQ(found.size(), 1U) << "a look is no command";
  EXPECT_EQ(found[0]["path"], "/api/v1/stop");
  EXPECT_EQ(found[0]["status"], 202);
  EXPECT_EQ(found[0]["method"], "POST");
  EXPECT_EQ(found[0]["request_id"], stopped.headers.at("x-request-id"));
  const std::scoped_lock lock(mutex_);
  const bool told = std::ranges::any_of(lines_, [](const json& line) {
    return line["level"] == "warning" && line["message"] == "stopped: left, right (operator)";
  });
  EXPECT_TRUE(told) << "alerts stand in it, too";
}

// Late feedback stops no arm by itself; its lost link does.
TEST_F(RequestLog, RecordsFindingsThatStopAnArm) {
  begin(LoggedRequests::none);
  ASSERT_EQ(post("/api/v1/sim/faults", R"({"arm": "left", "kind": "drift"})").status, 201);
  ASSERT_EQ(post("/api/v1/sim/faults", R"({"arm": "right", "kind": "drop_feedback"})").status, 201);
  const auto findings = [](const json& list, const char* text, const char* level) {
    std::vector<json> found;
    for (const json& one : list) {
      const bool is_finding = one[text].get<std::string>().starts_with("monitor: ");
      if (is_finding && one["level"] == level) found.push_back(one);
    }
    return found;
  };
  std::vector<json> stopping, others;
  for (int i = 0; i < 10'000 && (stopping.empty() || others.empty()); ++i) {
    const json alerts = get("/api/v1/alerts").json()["alerts"];
    stopping = findings(alerts, "text", "error");
    others = findings(alerts, "text", "warning");
  }
  ASSERT_FALSE(stopping.empty());
  ASSERT_FALSE(others.empty());
  const std::scoped_lock lock(mutex_);
  const auto logged = findings(lines_, "message", "error");
  ASSERT_FALSE(logged.empty());
  EXPECT_EQ(logged.front()["stopped"], "left");
  EXPECT_TRUE(std::ranges::any_of(
      stopping, [&](const json& alert) { return alert["text"] == logged.front()["message"]; }));
  EXPECT_TRUE(findings(lines_, "message", "warning").empty());
}

TEST_F(RequestLog, UsesTheClientsRequestIdIfValid) {
  begin(LoggedRequests::all);
  const auto ask = [&](const std::string& field) {
    const std::string answer = answer_to(
        "GET /api/v1/queue HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + field + "\r\n");
    const std::size_t at = answer.find("X-Request-Id: ");
    return at == answer.npos ? std::string()
                             : answer.substr(at + 14, answer.find("\r\n", at) - at - 14);
  };
  EXPECT_EQ(ask("X-Request-Id: station-4.17\r\n"), "station-4.17");
  EXPECT_EQ(requests().back()["request_id"], "station-4.17");
  const std::string own = ask("");
  EXPECT_TRUE(is_request_id(own)) << own;
  EXPECT_NE(ask(""), own);
  for (const std::string& bad :
       {std::string("a b"), std::string("<script>"), std::string(129, 'a')}) {
    const std::string made = ask("X-Request-Id: " + bad + "\r\n");
    EXPECT_TRUE(is_request_id(made) && made != bad) << made;
  }
}

TEST_F(RequestLog, InvalidHttpHasARequestIdToo) {
  begin(LoggedRequests::all);
  const std::string answer = answer_to("nonsense\r\n\r\n");
  EXPECT_NE(answer.find("400 "), std::string::npos);
  EXPECT_NE(answer.find("X-Request-Id: "), std::string::npos) << answer;
}

}  // namespace
}  // namespace armloom
