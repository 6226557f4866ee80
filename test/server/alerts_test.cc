#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "server/durable/alert_book.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;

class Alerts : public test::RunningServer {
 protected:
  void SetUp() override {
    options_.data = std::filesystem::path(::testing::TempDir()) / "armloom-alerts" /
                    ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(*options_.data);
    start(1);
    post("/api/v1/stop", "");
    post("/api/v1/resume", "");
  }
  json alerts() { return get("/api/v1/alerts").json()["alerts"]; }
  test::Answer acknowledge(const std::vector<std::string>& ids, const std::string& who) {
    return post("/api/v1/alerts/acknowledge", json{{"ids", ids}, {"who", who}}.dump());
  }
};

TEST_F(Alerts, RecordWhoAcknowledgedThemAndWhen) {
  test::Listener listener(port());
  json open = alerts();
  ASSERT_EQ(open.size(), 1U) << "that arms may go on again is no alert: " << open;
  EXPECT_EQ(open[0]["text"], "stopped: left, right (operator)");
  EXPECT_EQ(open[0]["level"], "warning");
  EXPECT_TRUE(open[0]["acknowledged"].is_null());

  const auto seen = acknowledge({open[0]["id"]}, "Ada");
  ASSERT_EQ(seen.status, 200) << seen.body;
  EXPECT_EQ(seen.json()["alerts"][0]["acknowledged"]["who"], "Ada");
  EXPECT_TRUE(seen.json()["alerts"][0]["acknowledged"]["at"].get<std::string>().ends_with("Z"));
  json told;
  do told = listener.next_of("alert")["data"];
  while (told["level"] != "info" || told["text"].get<std::string>().starts_with("resumed"));
  EXPECT_EQ(told["text"], "Ada acknowledged: stopped: left, right (operator)");

  EXPECT_EQ(acknowledge({open[0]["id"]}, "Bob").status, 200);
  EXPECT_EQ(alerts()[0]["acknowledged"]["who"], "Ada") << "whoever was the first one stays";
}

// A client that repeats a stop, as a PLC does, must not push other alerts out of sight.
TEST_F(Alerts, AreNotRaisedByAStopThatChangesNothing) {
  for (int i = 0; i < 3; ++i) EXPECT_EQ(post("/api/v1/stop", "").status, 202);
  EXPECT_EQ(alerts().size(), 2U) << "the first stop, and this one";
  post("/api/v1/resume", "");
  post("/api/v1/stop", "");
  EXPECT_EQ(alerts().size(), 3U);
}

TEST(AlertBook, KeepsErrorsAndUnacknowledgedAlertsLongest) {
  const WallClock clock({}, 1.0);
  AlertBook book("s", clock, nullptr);
  std::uint64_t seq = 0;
  const auto happens = [&](Alert::Level level) {
    book.happened({.seq = ++seq, .time = {}, .body = Alert{level, "x"}});
    return "s:" + std::to_string(seq);
  };
  const std::string error = happens(Alert::Level::error);
  const std::string warning = happens(Alert::Level::warning);
  std::string seen;
  for (std::size_t i = 2; i < kAlertsKept; ++i) seen = happens(Alert::Level::warning);
  book.acknowledge({seen}, "Ada", [](const auto&) {});
  happens(Alert::Level::warning);
  EXPECT_EQ(book.find(seen), nullptr) << "somebody has seen to it";
  EXPECT_NE(book.find(warning), nullptr);
  for (std::size_t i = 0; i < 2 * kAlertsKept; ++i) happens(Alert::Level::warning);
  EXPECT_EQ(book.find(warning), nullptr);
  EXPECT_NE(book.find(error), nullptr);
  EXPECT_EQ(book.alerts().size(), kAlertsKept);
}

TEST_F(Alerts, AreAcknowledgedAllOrNone) {
  const auto unknown = acknowledge({alerts()[0]["id"], "x:1"}, "Ada");
  EXPECT_EQ(unknown.status, 404);
  EXPECT_EQ(unknown.json()["pointer"], "/ids/1");
  EXPECT_TRUE(alerts()[0]["acknowledged"].is_null());
  EXPECT_EQ(post("/api/v1/alerts/acknowledge", R"({"ids": [1]})").status, 400);
  EXPECT_EQ(post("/api/v1/alerts/acknowledge", R"({"ids": [], "who": "\n"})").status, 422);
  for (const char* blank : {" ", "\xc2\xa0 \xe3\x80\x80"}) {
    const auto refused = acknowledge({}, blank);
    EXPECT_EQ(refused.status, 422) << "nobody would be told by this name";
    EXPECT_EQ(refused.json()["pointer"], "/who");
    EXPECT_EQ(refused.json()["value"], blank);
  }
  EXPECT_EQ(acknowledge({}, " Ada").status, 200);
}

TEST_F(Alerts, SurviveARestartWithTheirAcknowledgement) {
  const std::string first = alerts()[0]["id"];
  EXPECT_EQ(acknowledge({first}, "Ada").status, 200);
  post("/api/v1/arms/left/stop", "");
  json before = alerts();
  ASSERT_EQ(before.size(), 2U);
  end();
  start(1);
  // the arm is still stopped, and this session raises an alert about that again
  json after = alerts();
  ASSERT_GE(after.size(), 2U) << after;
  after.erase(after.begin(), after.end() - 2);
  EXPECT_EQ(after, before);
  EXPECT_EQ(after[1]["id"], first);
  EXPECT_EQ(after[1]["acknowledged"]["who"], "Ada");
  EXPECT_EQ(acknowledge({after[0]["id"]}, "").status, 200);
  EXPECT_EQ(alerts()[alerts().size() - 2]["acknowledged"]["who"], "127.0.0.1")
      << "who does not say, is where it came from";
}

}  // namespace
}  // namespace armloom
